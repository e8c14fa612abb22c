#include <engine/geometry/clip.hpp>
#include <engine/plan/boundary_points.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::plan {
namespace {

using geometry::PlacedPolygon;
using geometry::Polygon;
using geometry::Vector;

/// Calls `visit(edge, length)` for each edge of a chain, in order, wrapping at the ring's end.
template <class Visit>
void for_each_edge(const PlacedPolygon& placed, const localize::Chain& chain, Visit&& visit) {
    const Polygon& polygon = placed.polygon();
    const std::uint32_t begin = polygon.ring_begin(chain.ring);
    const std::uint32_t end = polygon.ring_end(chain.ring);
    std::uint32_t edge = chain.first;
    for (std::uint32_t i = 0; i < chain.count; ++i) {
        const std::uint32_t next = edge + 1 == end ? begin : edge + 1;
        visit(edge, (polygon.vertices()[next] - polygon.vertices()[edge]).norm());
        edge = next;
    }
}

/// An edge divided evenly: it has `parts` parts, of which first, ..., end - 1 can start inside a
/// box or on the way into it.
struct Division {
    double parts = 1.0;
    double first = 0.0;
    double end = 1.0;
};

Division divide(const PlacedPolygon& placed, std::uint32_t edge, double length, double spacing,
                const geometry::Box& within) {
    Division division;
    division.parts = std::max(1.0, std::ceil(length / spacing));
    division.end = division.parts;
    if (division.parts < 16.0) {
        return division;  // not worth a look
    }
    Vector a = placed.vertex(edge);
    Vector b = placed.vertex(placed.polygon().next(edge));
    const Vector start = a;
    const double whole = (b - a).norm();
    for (const int axis : {0, 1}) {
        if (!geometry::clip_to_slab(a, b, axis, within.min()[axis], within.max()[axis])) {
            division.end = 0.0;
            return division;
        }
    }
    // A part more at either end, for rounding.
    const double from = (a - start).norm() / whole * division.parts;
    const double to = (b - start).norm() / whole * division.parts;
    division.first = std::max(0.0, std::floor(from) - 1.0);
    division.end = std::min(division.parts, std::ceil(to) + 2.0);
    return division;
}

}  // namespace

Vector position(const PlacedPolygon& polygon, const BoundaryPoint& point) {
    Vector a = polygon.vertex(point.edge);
    if (point.parameter == 0.0) {
        return a;
    }
    return a + point.parameter * (polygon.vertex(polygon.polygon().next(point.edge)) - a);
}

void sample_chains(const PlacedPolygon& polygon, const std::vector<localize::Chain>& chains,
                   double spacing, const geometry::Box& within,
                   std::vector<BoundaryPoint>& points) {
    for (const localize::Chain& chain : chains) {
        // A chain's first vertex always starts a new sample: what came before is elsewhere.
        double since_last = spacing;
        for_each_edge(polygon, chain, [&](std::uint32_t edge, double length) {
            if (since_last + length <= spacing) {
                since_last += length;
                return;
            }
            const Division division = divide(polygon, edge, length, spacing, within);
            const auto end = static_cast<std::uint32_t>(division.end);
            for (auto part = static_cast<std::uint32_t>(division.first); part < end; ++part) {
                points.push_back({edge, part / division.parts});
            }
            since_last = division.end < division.parts ? spacing : length / division.parts;
        });
    }
}

void vertices_of_chains(const PlacedPolygon& polygon, const std::vector<localize::Chain>& chains,
                        std::vector<BoundaryPoint>& points) {
    for (const localize::Chain& chain : chains) {
        for_each_edge(polygon, chain, [&](std::uint32_t edge, double) {
            points.push_back({edge, 0.0});
        });
        // The chain's last vertex starts an edge that may be in no chain.
        const Polygon& shape = polygon.polygon();
        const std::uint32_t size = shape.ring_end(chain.ring) - shape.ring_begin(chain.ring);
        if (chain.count < size) {
            const std::uint32_t begin = shape.ring_begin(chain.ring);
            points.push_back({begin + (chain.first - begin + chain.count) % size, 0.0});
        }
    }
}

double most_samples(const PlacedPolygon& polygon, const std::vector<localize::Chain>& chains,
                    double spacing, const geometry::Box& within) {
    double count = 0.0;
    for (const localize::Chain& chain : chains) {
        for_each_edge(polygon, chain, [&](std::uint32_t edge, double length) {
            const Division division = divide(polygon, edge, length, spacing, within);
            count += std::max(0.0, division.end - division.first);
        });
    }
    return count;
}

}  // namespace nearfield::plan
