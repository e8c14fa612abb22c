#include <engine/base/interruption.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/queries/edge_sampler.hpp>

#include <algorithm>

namespace nearfield::queries {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

/// Calls `visit(edge, length)` for each edge of a chain, in order, wrapping at the ring's end.
template <class Visit>
void for_each_edge(const TransformedPolygon& placed, const geometry::Chain& chain, Visit&& visit) {
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

}  // namespace

void BoundaryPositions::enter(std::uint32_t edge) {
    edge_ = edge;
    start_ = polygon_.vertex(edge);
    way_ = polygon_.vertex(polygon_.polygon().next(edge)) - start_;
}

void sample_chains(const TransformedPolygon& polygon, const std::vector<geometry::Chain>& chains,
                   double spacing, const geometry::Box& within,
                   std::vector<BoundaryPoint>& points) {
    EdgeSampler sampler(polygon.polygon(), spacing);
    SparseCheckpoint<256> checkpoint;
    for (const geometry::Chain& chain : chains) {
        for_each_edge(polygon, chain, [&](std::uint32_t edge, double) {
            checkpoint.step();
            const double parts = sampler.parts_of(edge);
            const PartRange range = parts_within(polygon, edge, parts, within);
            // An edge may have more parts than 32 bits can count, but few of them lie in the box.
            const auto count = static_cast<std::uint32_t>(std::max(0.0, range.end - range.first));
            for (std::uint32_t i = 0; i < count; ++i) {
                points.push_back({edge, (range.first + i) / parts});
            }
        });
    }
}

void vertices_of_chains(const TransformedPolygon& polygon,
                        const std::vector<geometry::Chain>& chains,
                        std::vector<BoundaryPoint>& points) {
    for (const geometry::Chain& chain : chains) {
        for_each_edge(polygon, chain, [&](std::uint32_t edge, double) {
            points.push_back({edge, 0.0});
        });
        // The chain's last vertex starts an edge that may belong to no chain.
        const Polygon& shape = polygon.polygon();
        const std::uint32_t size = shape.ring_end(chain.ring) - shape.ring_begin(chain.ring);
        if (chain.count < size) {
            const std::uint32_t begin = shape.ring_begin(chain.ring);
            points.push_back({begin + (chain.first - begin + chain.count) % size, 0.0});
        }
    }
}

double max_vertices(const std::vector<geometry::Chain>& chains) {
    double count = 0.0;
    for (const geometry::Chain& chain : chains) {
        count += chain.count + 1.0;
    }
    return count;
}

double max_samples(const TransformedPolygon& polygon, const std::vector<geometry::Chain>& chains,
                   double spacing, const geometry::Box& within) {
    double count = 0.0;
    for (const geometry::Chain& chain : chains) {
        for_each_edge(polygon, chain, [&](std::uint32_t edge, double length) {
            const PartRange range =
                parts_within(polygon, edge, parts_of_length(length, spacing), within);
            count += std::max(0.0, range.end - range.first);
        });
    }
    return count;
}

double max_samples(const Polygon& polygon, double spacing) {
    return static_cast<double>(polygon.size()) + polygon.length_along_axes() / spacing;
}

}  // namespace nearfield::queries
