#pragma once

#include <engine/narrowphase/nearest_points.hpp>
#include <engine/narrowphase/ray_parities.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::narrowphase {

/// Where points lie relative to a boundary: on which side, where its nearest point is, and whether
/// that is unique. All points are answered together, which takes less time than one by one where
/// boxes do not tell the edges apart. Reuses its memory.
class LocatedPoints {
public:
    /// How far apart things have to be.
    struct Distances {
        double margin = 0.0;    ///< for uniqueness, see Boundary::is_unique()
        double touching = 0.0;  ///< points nearer to the boundary are not inside
        double reach = 0.0;     ///< of points farther from the boundary only the nearest is found
    };

    /// `points`: at best in order along lines. Points, whose arrays need the padding that kernels
    /// read, and edges, which are small or complete, must outlive the queries.
    void find(const simd::PointArrays& points, const simd::TransformedEdges& edges,
              const Distances& distances);

    /// Indexed by point.
    [[nodiscard]] const simd::NearestArrays& nearest() const { return nearest_.arrays(); }
    /// Boundary::is_unique() for point i.
    [[nodiscard]] bool is_unique(std::size_t i) { return nearest_.is_unique(i); }
    /// False for points that touch the boundary. Precondition: point i is within reach.
    [[nodiscard]] bool is_inside(std::size_t i) const { return parities_.is_odd(sides_[i]); }

private:
    NearestPoints nearest_;
    RayParities parities_;
    std::vector<RayParities::Ticket> sides_;
};

/// How many points of a long list to locate at once: so many that crowded edges take no more time
/// than in one list, while the memory stays in proportion to the edges.
[[nodiscard]] inline std::size_t points_at_once(std::size_t edges) {
    constexpr std::size_t least = std::size_t{1} << 16U;
    constexpr std::size_t by_edge = 8;
    return std::max(least, by_edge * edges);
}

}  // namespace nearfield::narrowphase
