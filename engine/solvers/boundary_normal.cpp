#include <engine/solvers/boundary_normal.hpp>

namespace nearfield::solvers {
namespace {

using geometry::Vector;
using narrowphase::AskedNormal;
using narrowphase::Boundary;

// At this parameter from an end of an edge, its sides are the edge's own, not a neighbour's.
constexpr double just_inside = 1.0 / 1024.0;

/// Where the rounding of vertices in the world has made one point of a whole ring: a normal of an
/// edge in its own frame, on either side.
AskedNormal normal_of_collapsed(const geometry::TransformedPolygon& placed, std::uint32_t edge) {
    const geometry::Polygon& polygon = placed.polygon();
    const auto way_of = [&](std::uint32_t i) -> Vector {
        return polygon.vertices()[polygon.next(i)] - polygon.vertices()[i];
    };
    std::uint32_t other = edge;
    while (way_of(other).isZero(0.0) && polygon.next(other) != edge) {
        other = polygon.next(other);
    }
    const Vector way = placed.rotation() * way_of(other).normalized();
    return {.left = {-way.y(), way.x()}};
}

AskedNormal ask_normal(Boundary& boundary, std::uint32_t edge, double parameter) {
    const geometry::Polygon& polygon = boundary.polygon().polygon();
    AskedNormal asked = boundary.ask_outward_normal(edge, parameter);
    for (std::uint32_t other = polygon.next(edge); asked.left.isZero() && other != edge;
         other = polygon.next(other)) {
        asked = boundary.ask_outward_normal(other, just_inside);
    }
    return asked.left.isZero() ? normal_of_collapsed(boundary.polygon(), edge) : asked;
}

}  // namespace

AskedBoundaryNormal ask_outward_normal(Boundary& boundary, std::uint32_t edge, double parameter) {
    return {{}, ask_normal(boundary, edge, parameter), false};
}

AskedBoundaryNormal ask_outward_normal_at(Boundary& boundary, const queries::BoundaryPoint& point) {
    if (point.parameter > 0.0) {
        return ask_outward_normal(boundary, point.edge, point.parameter);
    }
    const geometry::Polygon& polygon = boundary.polygon().polygon();
    return {ask_normal(boundary, polygon.previous(point.edge), 1.0 - just_inside),
            ask_normal(boundary, point.edge, just_inside), true};
}

Vector outward_normal(const Boundary& boundary, const AskedBoundaryNormal& asked) {
    Vector after = boundary.outward_normal(asked.after);
    if (!asked.at_vertex) {
        return after;
    }
    const Vector sum = boundary.outward_normal(asked.before) + after;
    const double length = sum.norm();
    return length > 1e-9 ? Vector(sum / length) : after;
}

}  // namespace nearfield::solvers
