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

// So many vertices are boxed sooner than some of them are picked out.
constexpr std::uint32_t boxed_at_once = 4096;

/// The box of all vertices, or of some of very many.
Box rough_box(const PlacedPolygon& placed) {
    Box box;
    const Polygon& polygon = placed.polygon();
    if (polygon.size() <= boxed_at_once) {
        box = placed.box();
    } else {
        for (std::uint32_t i = 0; i < polygon.size(); i += stride_of(polygon)) {
            box.extend(placed.vertex(i));
        }
    }
    return box;
}

Box grown(Box box, double by) {
    box.min().array() -= by;
    box.max().array() += by;
    return box;
}

/// How many samples a cell apart the boundary has within a box. `own`: its rough box.
double boundary_samples(const PlacedPolygon& placed, const Box& own, const Box& within,
                        double cell) {
    if (!own.intersects(within)) {
        return 0.0;
    }
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

/// Where both shapes can be; rough boxes are a little too small.
Box common_box(const PlacedPolygon& a, const PlacedPolygon& b, double grow) {
    return grown(rough_box(a), grow).intersection(grown(rough_box(b), grow));
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
        const Box within = rough_box(PlacedPolygon(b, query.b.pose));
        return {&TechniqueCost::points, edges(),
                boundary_samples(placed, rough_box(placed), within,
                                 query.tolerance * std::numbers::sqrt2)};
    }

    Work operator()(const ContactQuery& query) const {
        const PlacedPolygon placed_a(*a, query.a.pose);
        const PlacedPolygon placed_b(b, query.b.pose);
        const double cell = query.tolerance * std::numbers::sqrt2;
        const Box box_a = rough_box(placed_a);
        const Box box_b = rough_box(placed_b);
        const double reach = query.contact_distance;
        return {&TechniqueCost::points, edges(),
                boundary_samples(placed_a, box_a, grown(box_b, reach), cell) +
                    boundary_samples(placed_b, box_b, grown(box_a, reach), cell)};
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
