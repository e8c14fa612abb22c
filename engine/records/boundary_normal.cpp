#include <engine/records/boundary_normal.hpp>

namespace nearfield::records {
namespace {

using geometry::Vector;

// At this parameter from an end of an edge, its sides are the edge's own, not a neighbour's.
constexpr double just_inside = 1.0 / 1024.0;

}  // namespace

Vector outward_normal(narrowphase::Boundary& boundary, std::uint32_t edge, double parameter) {
    const geometry::Polygon& polygon = boundary.polygon().polygon();
    Vector normal = boundary.outward_normal(edge, parameter);
    for (std::uint32_t other = polygon.next(edge); normal.isZero() && other != edge;
         other = polygon.next(other)) {
        normal = boundary.outward_normal(other, just_inside);
    }
    return normal;
}

Vector outward_normal_at(narrowphase::Boundary& boundary, const plan::BoundaryPoint& point) {
    if (point.parameter > 0.0) {
        return outward_normal(boundary, point.edge, point.parameter);
    }
    const geometry::Polygon& polygon = boundary.polygon().polygon();
    const Vector after = outward_normal(boundary, point.edge, just_inside);
    const Vector sum =
        outward_normal(boundary, polygon.previous(point.edge), 1.0 - just_inside) + after;
    const double length = sum.norm();
    return length > 1e-9 ? Vector(sum / length) : after;
}

}  // namespace nearfield::records
