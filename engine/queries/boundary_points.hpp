#pragma once

#include <engine/geometry/overlap.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nearfield::queries {

/// A point on the boundary of A: on edge `edge`, at the fraction `parameter` of its length.
struct BoundaryPoint {
    std::uint32_t edge = 0;
    double parameter = 0.0;  ///< 0: the edge's first vertex; below 1
};

/// Positions of points on a boundary in world coordinates; fastest where consecutive points lie on
/// the same edge.
class BoundaryPositions {
public:
    explicit BoundaryPositions(const geometry::TransformedPolygon& polygon) : polygon_(polygon) {}

    [[nodiscard]] geometry::Vector operator()(const BoundaryPoint& point) {
        if (point.edge != edge_) {
            enter(point.edge);
        }
        return point.parameter == 0.0 ? start_ : geometry::Vector(start_ + point.parameter * way_);
    }

private:
    void enter(std::uint32_t edge);

    geometry::TransformedPolygon polygon_;
    std::uint32_t edge_ = std::numeric_limits<std::uint32_t>::max();  // the one that follows
    geometry::Vector start_ = geometry::Vector::Zero();
    geometry::Vector way_ = geometry::Vector::Zero();  // to its end
};

/// The position of a single point.
[[nodiscard]] inline geometry::Vector position(const geometry::TransformedPolygon& polygon,
                                               const BoundaryPoint& point) {
    return BoundaryPositions(polygon)(point);
}

/// Appends samples along each chain. Inside the box `within`, consecutive samples are at most
/// `spacing` apart along the boundary; outside the box, samples are unspecified. Long edges are
/// divided evenly from vertex to vertex, so corners are sampled. Vertices closer together than
/// `spacing` are thinned out, but the first vertex in each group of 64 edges of a ring, counted
/// from the ring's first vertex, is always sampled. The samples on an edge depend only on the
/// polygon and the spacing, so the last sample before a chain may lie outside the chain.
void sample_chains(const geometry::TransformedPolygon& polygon,
                   const std::vector<geometry::Chain>& chains, double spacing,
                   const geometry::Box& within, std::vector<BoundaryPoint>& points);

/// Appends the first vertex of every edge of the chains, and the last vertex of each chain.
void vertices_of_chains(const geometry::TransformedPolygon& polygon,
                        const std::vector<geometry::Chain>& chains,
                        std::vector<BoundaryPoint>& points);

/// Upper bound on the number of points that vertices_of_chains() appends.
[[nodiscard]] double max_vertices(const std::vector<geometry::Chain>& chains);

/// Upper bound on the number of samples that sample_chains() appends; allocates nothing. A double,
/// since it may be huge.
[[nodiscard]] double max_samples(const geometry::TransformedPolygon& polygon,
                                 const std::vector<geometry::Chain>& chains, double spacing,
                                 const geometry::Box& within);

/// Rough upper bound for the whole boundary: exceeds the true number by at most half, plus a few.
[[nodiscard]] double max_samples(const geometry::Polygon& polygon, double spacing);

}  // namespace nearfield::queries
