#include <engine/geometry/clip.hpp>
#include <engine/plan/boundary_points.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Every so many edges of a ring its samples start anew, at a vertex: what is sampled depends on
/// nothing farther back.
constexpr std::uint32_t most_edges_back = 64;

/// Samples edges of one polygon, in any order; the least is done for edges that follow each other.
class EdgeSampler {
public:
    EdgeSampler(const PlacedPolygon& placed, double spacing, const geometry::Box& within)
        : placed_(placed), spacing_(spacing), within_(within) {}

    void append_samples(std::uint32_t edge, std::vector<BoundaryPoint>& points) {
        const double edge_length = length(edge);
        if (edge != next_ && edge_length <= spacing_) {
            catch_up(edge);
        }
        const Division division = advance(edge, edge_length);
        const auto end = static_cast<std::uint32_t>(division.end);
        for (auto part = static_cast<std::uint32_t>(division.first); part < end; ++part) {
            points.push_back({edge, part / division.parts});
        }
    }

private:
    [[nodiscard]] double length(std::uint32_t edge) const {
        const Polygon& polygon = placed_.polygon();
        return (polygon.vertices()[polygon.next(edge)] - polygon.vertices()[edge]).norm();
    }

    [[nodiscard]] bool starts_anew(std::uint32_t edge) const {
        const Polygon& polygon = placed_.polygon();
        return (edge - polygon.ring_begin(polygon.ring_of(edge))) % most_edges_back == 0;
    }

    /// Walks back to where the samples of a short edge can be told from, and up to it again.
    void catch_up(std::uint32_t edge) {
        std::uint32_t from = edge;
        double from_length = 0.0;
        while (from_length <= spacing_ && !starts_anew(from)) {
            from_length = length(--from);
        }
        for (; from < edge; ++from) {
            static_cast<void>(advance(from, length(from)));
        }
    }

    /// The samples of an edge, from the samples before.
    [[nodiscard]] Division advance(std::uint32_t edge, double edge_length) {
        next_ = edge + 1;
        if (edge_length <= spacing_ && !starts_anew(edge) &&
            since_last_ + edge_length <= spacing_) {
            since_last_ += edge_length;
            return {1.0, 0.0, 0.0};
        }
        const Division division = divide(placed_, edge, edge_length, spacing_, within_);
        since_last_ = division.end < division.parts ? spacing_ : edge_length / division.parts;
        return division;
    }

    const PlacedPolygon& placed_;
    double spacing_;
    const geometry::Box& within_;
    std::uint32_t next_ = std::numeric_limits<std::uint32_t>::max();  // edge, if none is left out
    double since_last_ = 0.0;  // sample, along the boundary to the next edge
};

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
    EdgeSampler sampler(polygon, spacing, within);
    for (const localize::Chain& chain : chains) {
        for_each_edge(polygon, chain,
                      [&](std::uint32_t edge, double) { sampler.append_samples(edge, points); });
    }
}

void sample_edges(const PlacedPolygon& polygon, std::span<const std::uint32_t> edges,
                  double spacing, const geometry::Box& within, std::vector<BoundaryPoint>& points) {
    EdgeSampler sampler(polygon, spacing, within);
    for (const std::uint32_t edge : edges) {
        sampler.append_samples(edge, points);
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

double most_samples(const Polygon& polygon, double spacing) {
    return static_cast<double>(polygon.size()) + polygon.length_along_axes() / spacing;
}

}  // namespace nearfield::plan
