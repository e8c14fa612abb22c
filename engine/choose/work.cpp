#include <engine/choose/work.hpp>
#include <engine/geometry/placed_polygon.hpp>
#include <engine/plan/field_parts.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace nearfield::choose {
namespace {

using geometry::Box;
using geometry::PlacedPolygon;
using geometry::Polygon;

// Vertices of a shape that an estimate looks at: enough for a tenth, and less than any answer
// takes.
constexpr std::uint32_t looked_at = 256;

std::uint32_t stride_of(const Polygon& polygon) {
    return std::max(1U, polygon.size() / looked_at);
}

/// The box of some of the vertices.
Box rough_box(const PlacedPolygon& placed, double grow) {
    Box box;
    const Polygon& polygon = placed.polygon();
    for (std::uint32_t i = 0; i < polygon.size(); i += stride_of(polygon)) {
        box.extend(placed.vertex(i));
    }
    box.min().array() -= grow;
    box.max().array() += grow;
    return box;
}

/// How many samples a cell apart the boundary has within a box.
double boundary_samples(const PlacedPolygon& placed, const Box& within, double cell) {
    const Polygon& polygon = placed.polygon();
    const std::uint32_t stride = stride_of(polygon);
    double samples = 0.0;
    for (std::uint32_t i = 0; i < polygon.size(); i += stride) {
        const geometry::Vector from = placed.vertex(i);
        const geometry::Vector to = placed.vertex(polygon.next(i));
        const Box edge(from.cwiseMin(to), from.cwiseMax(to));
        const Box inside = edge.intersection(within);
        if (!inside.isEmpty()) {
            samples += 1.0 + std::min(inside.diagonal().norm(), (to - from).norm()) / cell;
        }
    }
    return samples * stride;
}

double cells_of(const Box& box, double cell) {
    if (box.isEmpty()) {
        return 0.0;
    }
    const geometry::Vector sides = box.sizes() / cell;
    return (sides.x() + 1.0) * (sides.y() + 1.0);
}

/// Where both shapes can be; the boxes are rough, so a little too small.
Box common_box(const PlacedPolygon& a, const PlacedPolygon& b, double grow) {
    return rough_box(a, grow).intersection(rough_box(b, grow));
}

struct Estimate {
    const Polygon* a;
    const Polygon& b;

    [[nodiscard]] double edges() const {
        return static_cast<double>(b.size()) +
               (a == nullptr ? 0.0 : static_cast<double>(a->size()));
    }

    Work operator()(const PenetrationQuery& query) const {
        if (query.points == PenetrationPoints::vertices) {
            // No look at the shapes: answers to small ones take no longer than that.
            return {&TechniqueCost::points, edges(), static_cast<double>(a->size())};
        }
        const PlacedPolygon placed(*a, query.a.pose);
        const Box within = rough_box(PlacedPolygon(b, query.b.pose), 0.0);
        return {&TechniqueCost::points, edges(),
                boundary_samples(placed, within, query.tolerance * std::numbers::sqrt2)};
    }

    Work operator()(const ContactQuery& query) const {
        const PlacedPolygon placed_a(*a, query.a.pose);
        const PlacedPolygon placed_b(b, query.b.pose);
        const double cell = query.tolerance * std::numbers::sqrt2;
        const Box near_a = rough_box(placed_a, query.contact_distance);
        const Box near_b = rough_box(placed_b, query.contact_distance);
        return {
            &TechniqueCost::points, edges(),
            boundary_samples(placed_a, near_b, cell) + boundary_samples(placed_b, near_a, cell)};
    }

    Work operator()(const ClosestPointQuery&) const { return {&TechniqueCost::closest, edges()}; }
    Work operator()(const SeparationQuery&) const { return {&TechniqueCost::closest, edges()}; }
    Work operator()(const IntersectionTestQuery&) const {
        return {&TechniqueCost::closest, edges()};
    }
    // Several separations; one technique alone answers it.
    Work operator()(const TimeOfImpactQuery&) const { return {&TechniqueCost::closest, edges()}; }
    Work operator()(const SeparationVectorQuery&) const {
        return {&TechniqueCost::closest, edges()};
    }

    Work operator()(const IntersectionQuery& query) const {
        const Box box =
            common_box(PlacedPolygon(*a, query.a.pose), PlacedPolygon(b, query.b.pose), 0.0);
        return {&TechniqueCost::intersection, edges(),
                cells_of(box, query.tolerance * std::numbers::sqrt2)};
    }

    Work operator()(const DistanceFieldQuery& query) const {
        const plan::FieldParts parts = plan::field_parts(query);
        Box box;
        if (query.rectangle) {
            box = Box(geometry::to_vector(query.rectangle->min),
                      geometry::to_vector(query.rectangle->max));
        } else if (a != nullptr) {
            box = common_box(PlacedPolygon(*a, query.a.pose), PlacedPolygon(b, query.b.pose),
                             query.tolerance);
        }
        double cells = cells_of(box, query.tolerance * std::numbers::sqrt2);
        if (!query.values && !query.features && !query.gradients) {
            cells = static_cast<double>(query.points.size() * parts.cells_per_point);
        }
        return {parts.features ? &TechniqueCost::features : &TechniqueCost::field,
                static_cast<double>(b.size()), cells};
    }
};

}  // namespace

Work work_of(const AnyQuery& query, const Polygon* a, const Polygon& b) {
    return std::visit(Estimate{a, b}, query);
}

}  // namespace nearfield::choose
