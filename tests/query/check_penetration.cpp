#include <tests/oracle/boundary.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/check_nearest.hpp>
#include <tests/query/point_index.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

using oracle::Nearest;
using oracle::ShapeOracle;

void check_record(Report& report, const PlacedPair& pair, const PenetratingPoint& record) {
    const double d = pair.tolerance();
    const double allowed = allowed_rounding(pair);
    check_nearest(report, {pair.a(), pair.b(), d, allowed},
                  {record.position, record.depth, record.nearest, record.feature, record.unique});
    const auto require_at_most = [&](double value, double most, const char* what) {
        report.require(value <= most, "record at ", record.position.x, ", ", record.position.y,
                       " depth ", record.depth, ": ", what, ' ', value);
    };
    require_at_most(pair.b().signed_distance(record.position), 1e-3 * d,
                    "the point is outside B by");
    require_at_most(std::abs(oracle::length(record.direction) - 1.0), 1e-9,
                    "the direction's length is off by");
    const Vector2 reached =
        oracle::plus(record.position, oracle::times(record.direction, record.depth));
    require_at_most(oracle::distance(reached, record.nearest), allowed,
                    "point + depth * direction misses `nearest` by");
    report.require(record.depth > 0.0, "depth ", record.depth);
}

/// The lowest position of the point along A's rings, not before `from`; infinity if there is none.
double place_along(const ShapeOracle& a, const Vector2& point, double from, double allowed) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Nearest& on_edge : a.edges_within(point, allowed)) {
        const double within = on_edge.feature.kind == Feature::Kind::edge ? 0.5 : 0.0;
        const double place = on_edge.feature.index + within;
        if (place >= from) {
            lowest = std::min(lowest, place);
        }
    }
    return lowest;
}

/// Records must follow A's rings: edge numbers never decrease, except for at most one wrap per
/// ring.
void check_order(Report& report, const PlacedPair& pair, const PenetrationResult& result) {
    const double allowed = allowed_rounding(pair);
    std::size_t falls = 0;
    double place = 0.0;
    for (const PenetratingPoint& record : result.points) {
        double next = place_along(pair.a(), record.position, place, allowed);
        if (std::isinf(next)) {
            ++falls;
            next = place_along(pair.a(), record.position, 0.0, allowed);
        }
        place = std::isinf(next) ? 0.0 : next;
    }
    report.require(falls <= pair.a().ring_begins().size(), "records go back along A ", falls,
                   " times; A has ", pair.a().ring_begins().size(), " rings");
}

void check_deepest(Report& report, const PlacedPair& pair, PenetrationPoints points,
                   const PenetrationResult& result) {
    double deepest = 0.0;
    bool found = result.points.empty();
    for (const PenetratingPoint& record : result.points) {
        deepest = std::max(deepest, record.depth);
        found = found || record.position == result.deepest.position;
    }
    if (result.count > 0) {
        report.require(result.deepest.depth == deepest && found, "deepest is ",
                       result.deepest.depth, ", the deepest record ", deepest);
    }
    const oracle::Deepest truth =
        points == PenetrationPoints::vertices
            ? oracle::deepest_vertex(pair.a(), pair.b())
            : oracle::deepest_on_boundary(pair.a(), pair.b(), pair.tolerance() / 10);
    const double allowed = allowed_rounding(pair);
    report.require(deepest >= truth.depth - result.error_bound - allowed, "deepest is ", deepest,
                   " with a bound of ", result.error_bound, "; A's boundary at ", truth.point.x,
                   ", ", truth.point.y, " is at depth ", truth.depth);
    // Any of several edges that are equally near within d/1000 may be reported, including the
    // farther one.
    const double choice = 1e-3 * pair.tolerance();
    report.require(result.count == 0 || deepest <= std::max(truth.upper, 0.0) + choice + allowed,
                   "deepest is ", deepest, ", but no point of A's boundary is deeper than ",
                   truth.upper);
}

void check_boundary_complete(Report& report, const PlacedPair& pair,
                             const PenetrationResult& result) {
    constexpr std::size_t max_samples = 4000;
    const double d = pair.tolerance();
    PointIndex records(2 * d * (1 + 1e-9));
    for (const PenetratingPoint& record : result.points) {
        records.add(record.position);
    }
    for (const Vector2& p : oracle::sample_boundary(pair.a(), d / 2, max_samples)) {
        report.require(records.has_near(p) || pair.b().depth(p) <= d, "no record within 2 d of ",
                       p.x, ", ", p.y, " on A's boundary, which is deep inside B");
    }
}

void check_vertices_complete(Report& report, const PlacedPair& pair,
                             const PenetrationResult& result) {
    const double close_call = 1e-3 * pair.tolerance() + pair.rounding();
    const double same = allowed_rounding(pair);
    PointIndex records(same);
    for (const PenetratingPoint& record : result.points) {
        records.add(record.position);
    }
    PointIndex vertices(same);
    std::size_t certain = 0;
    std::size_t possible = 0;
    for (std::uint32_t i = 0; i < pair.a().size(); ++i) {
        const Vector2 v = pair.a().vertex(i);
        const double depth = pair.b().depth(v);
        vertices.add(v);
        certain += depth > close_call ? 1U : 0U;
        possible += depth > -close_call ? 1U : 0U;
        report.require(depth <= close_call || records.has_near(v), "vertex ", i, " at ", v.x, ", ",
                       v.y, " of depth ", depth, " has no record");
    }
    for (const PenetratingPoint& record : result.points) {
        report.require(vertices.has_near(record.position), "the record at ", record.position.x,
                       ", ", record.position.y, " is at no vertex of A");
    }
    report.require(result.count >= certain && result.count <= possible, result.count, " records; ",
                   certain, " to ", possible, " vertices are inside");
}

}  // namespace

void check_penetration(const PlacedPair& pair, PenetrationPoints points,
                       const PenetrationResult& result) {
    Report report(points == PenetrationPoints::boundary ? "penetration of the boundary"
                                                        : "penetration of the vertices");
    check_summary(report, result, pair);
    if (!result.status.ok()) {
        return;
    }
    report.require(result.count == result.points.size(), "count ", result.count, ", ",
                   result.points.size(), " records");
    for (const PenetratingPoint& record : result.points) {
        check_record(report, pair, record);
    }
    check_order(report, pair, result);
    check_deepest(report, pair, points, result);
    if (points == PenetrationPoints::boundary) {
        check_boundary_complete(report, pair, result);
    } else {
        check_vertices_complete(report, pair, result);
    }
}

}  // namespace nearfield::test
