#include <engine/base/status_exception.hpp>
#include <engine/context/calibration_workloads.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::calibration {
namespace {

std::vector<Vector2> star(std::uint32_t vertices) {
    std::vector<Vector2> ring;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / vertices;
        double radius = 1.0 + 0.15 * std::cos(5.0 * angle);
        for (const double waves : {13.0, 37.0, 101.0, 283.0, 787.0}) {
            radius += std::cos(waves * (angle + 1.0)) / waves;
        }
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ring;
}

// Deeply overlapping, and separated; both rotated.
const Pose overlapping{{0.7, 0.2}, 0.4};
const Pose apart{{3.0, 0.5}, 0.4};
// Around the whole star, with cells far from its boundary.
const Rectangle window{{-1.5, -1.5}, {1.5, 1.5}};

template <class Query>
Query pair(ShapeHandle shape, const Pose& pose, double tolerance) {
    Query query;
    query.a = {shape, {}};
    query.b = {shape, pose};
    query.tolerance = tolerance;
    return query;
}

AnyQuery points(ShapeHandle shape, double tolerance) {
    auto query = pair<PenetrationQuery>(shape, overlapping, tolerance);
    query.records = false;
    return query;
}

AnyQuery closest(ShapeHandle shape, double tolerance) {
    return pair<SeparationQuery>(shape, apart, tolerance);
}

AnyQuery intersection(ShapeHandle shape, double tolerance) {
    auto query = pair<IntersectionQuery>(shape, overlapping, tolerance);
    query.records = false;
    return query;
}

AnyQuery features(ShapeHandle shape, double tolerance) {
    auto query = pair<DistanceFieldQuery>(shape, {}, tolerance);
    query.rectangle = window;
    query.features = true;
    return query;
}

}  // namespace

Star::Star(std::uint32_t vertices) : ring(star(vertices)) {
    const Ring rings[] = {Ring(ring)};
    const Status status = polygon.assign(rings);
    if (!status.ok()) {
        throw StatusException(status);
    }
}

AnyQuery field(ShapeHandle shape, double tolerance) {
    auto query = pair<DistanceFieldQuery>(shape, {}, tolerance);
    query.rectangle = window;
    return query;
}

// Edges are measured with some cells: their number decides what lists of edges take.
const std::array<Kind, 5> kinds{{
    {&QueryCosts::points, 0.2, 0.2, 0.001, false, points},
    {&QueryCosts::closest, 0.2, 0.2, 0.2, false, closest},
    {&QueryCosts::intersection, 0.2, 0.02, 0.0005, false, intersection},
    {&QueryCosts::field, 0.2, 0.015, 0.003, true, field},
    {&QueryCosts::features, 0.2, 0.04, 0.01, true, features},
}};

}  // namespace nearfield::calibration
