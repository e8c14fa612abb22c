#include <tests/oracle/overlap.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>

#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

using oracle::Nearest;
using oracle::ShapeOracle;

/// True if a pair of boundary points within `limit` of each other has a point farther than `apart`
/// from that of the closest pair. Searches the vertices of both, which suffices.
bool has_rival(const PlacedPair& pair, const SeparationResult& result, double limit, double apart) {
    const auto elsewhere = [&](const Vector2& on_a, const Vector2& on_b) {
        return oracle::distance(on_a, result.point_a) > apart ||
               oracle::distance(on_b, result.point_b) > apart;
    };
    for (std::uint32_t i = 0; i < pair.a().size(); ++i) {
        const Vector2 v = pair.a().vertex(i);
        for (const Nearest& nearest : pair.b().edges_within(v, limit)) {
            if (elsewhere(v, nearest.point)) {
                return true;
            }
        }
    }
    for (std::uint32_t i = 0; i < pair.b().size(); ++i) {
        const Vector2 v = pair.b().vertex(i);
        for (const Nearest& nearest : pair.a().edges_within(v, limit)) {
            if (elsewhere(nearest.point, v)) {
                return true;
            }
        }
    }
    return false;
}

void check_feature(Report& report, const ShapeOracle& shape, const Feature& feature,
                   const Vector2& point, double allowed) {
    double off = std::numeric_limits<double>::infinity();
    if (feature.index < shape.size()) {
        off = feature.kind == Feature::Kind::vertex
                  ? oracle::distance(shape.vertex(feature.index), point)
                  : shape.nearest_on_edge(feature.index, point).distance;
    }
    report.require(off <= allowed, "a closest point is off its feature by ", off);
}

void check_common_point(Report& report, const PlacedPair& pair, const SeparationResult& result,
                        double allowed) {
    report.require(result.distance == 0.0 && result.point_a == result.point_b &&
                       result.direction == Vector2{} && result.sampled_distance == 0.0,
                   "shapes that intersect are ", result.distance, " apart, or their points are");
    for (const ShapeOracle* shape : {&pair.a(), &pair.b()}) {
        const double outside = shape->signed_distance(result.point_a);
        report.require(outside <= allowed, "the common point ", result.point_a.x, ", ",
                       result.point_a.y, " is outside a shape by ", outside);
    }
}

void check_apart(Report& report, const PlacedPair& pair, const SeparationResult& result,
                 double allowed) {
    const double truth = oracle::boundary_distance(pair.a(), pair.b());
    report.require(std::abs(result.distance - truth) <= result.error_bound + allowed,
                   "the distance is ", result.distance, ", not ", truth);
    const double between = oracle::distance(result.point_a, result.point_b);
    report.require(std::abs(between - result.distance) <= allowed, "the points are ", between,
                   " apart, the distance is ", result.distance);
    report.require(pair.a().nearest(result.point_a).distance <= allowed, "point A is off A");
    report.require(pair.b().nearest(result.point_b).distance <= allowed, "point B is off B");
    check_feature(report, pair.a(), result.feature_a, result.point_a, allowed);
    check_feature(report, pair.b(), result.feature_b, result.point_b, allowed);
    const Vector2 reached =
        oracle::plus(result.point_a, oracle::times(result.direction, result.distance));
    report.require(oracle::distance(reached, result.point_b) <= allowed &&
                       std::abs(oracle::length(result.direction) - 1.0) < 1e-9,
                   "the direction does not lead from A to B");
    report.require(result.sampled_distance >= result.distance - allowed &&
                       result.sampled_distance <= result.distance + result.cell + allowed,
                   "the rendered points are ", result.sampled_distance, " apart, the distance is ",
                   result.distance);
    const double d = pair.tolerance();
    if (result.unique) {
        report.require(!has_rival(pair, result, result.distance + 0.9e-3 * d - 2 * allowed,
                                  1.01 * d + allowed),
                       "called unique, and another pair is as close");
    } else {
        report.require(
            has_rival(pair, result, result.distance + 1.1e-3 * d + 2 * allowed, 0.99 * d - allowed),
            "called not unique, and no other pair is as close");
    }
}

}  // namespace

void check_separation(const PlacedPair& pair, const SeparationResult& result) {
    Report report("separation");
    check_search_summary(report, result, pair);
    if (!result.status.ok()) {
        return;
    }
    // Rounding errors in double precision of both the library and the oracle.
    const double allowed = 4.0 * pair.rounding() + 1e-15 * result.distance;
    report.require(result.error_bound <= pair.tolerance(), "the bound is ", result.error_bound);
    if (result.intersects) {
        check_common_point(report, pair, result, allowed);
    } else {
        check_apart(report, pair, result, allowed);
    }
}

void check_same(const SeparationResult& separation, const ClosestPointResult& closest) {
    Report report("closest point");
    report.require(closest.status.ok() == separation.status.ok() &&
                       closest.intersects == separation.intersects,
                   "status or `intersects` differs from the separation's");
    report.require(closest.distance == separation.distance, "the closest point is ",
                   closest.distance, " away, the separation ", separation.distance);
    // If the pair is unique, so is A's point of it; otherwise either may be reported.
    report.require(!separation.unique || (closest.unique && closest.point == separation.point_a &&
                                          closest.nearest == separation.point_b),
                   "closest point and separation differ");
}

}  // namespace nearfield::test
