#pragma once

#include <engine/base/interruption.hpp>
#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/nearest_points.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::narrowphase {

/// The one of several points that is farthest from a boundary.
struct DeepestPoint {
    std::uint32_t count = 0;  ///< number of points that are not on the boundary
    std::uint32_t point = 0;  ///< of equally deep ones the first; undefined if `count` is 0
    simd::NearestOfEdges
        nearest;  ///< its nearest edge; the distance bound for other edges may be missing (0)
};

/// Finds which of some points is farthest from a transformed polygon's boundary. Adaptive
/// (Lipschitz) sampling: the depths of two points differ by at most the length of the path between
/// them, so most of many closely spaced points need no distance query. Reuses its memory.
class DeepestPointFinder {
public:
    /// Points nearer to the boundary than `touching` count as on it. `margin`: for uniqueness, see
    /// Boundary::is_unique(). Point arrays need the padding that kernels read; edges are small or
    /// complete.
    [[nodiscard]] DeepestPoint find(const simd::PointArrays& points,
                                    const simd::TransformedEdges& edges, double touching,
                                    double margin);

private:
    /// The depth of a point.
    struct DepthProbe {
        std::uint32_t point;
        double depth;
    };
    /// Every point at a multiple of this is probed first.
    static constexpr std::uint32_t stride = 32;

    [[nodiscard]] bool is_crowded();
    void find_together(double margin);
    void find_by_adaptive_sampling();

    [[nodiscard]] DepthProbe sound(std::uint32_t point);
    /// Counts a point, and records it if it is deeper. `edge`: its nearest edge.
    void take(std::uint32_t point, double depth, std::uint32_t edge);
    /// Refines between two probed points as far as necessary. `way`: path length along the points
    /// up to each, measured from `origin`.
    void search_between(const DepthProbe& low, const DepthProbe& high, const double* way,
                        std::uint32_t origin);
    /// Evaluates a few points together.
    void look_between(std::uint32_t first, std::uint32_t end);

    simd::PointArrays points_;
    const simd::TransformedEdges* edges_ = nullptr;
    double touching_ = 0.0;
    double depth_ = 0.0;  // of the deepest so far
    DeepestPoint deepest_;
    Boundary boundary_;        // of edges that are not small
    NearestPoints nearest_;    // to the points
    std::uint32_t guess_ = 0;  // an edge near the last point probed
    std::vector<DepthProbe> probes_;
    std::vector<std::uint32_t> near_;  // scratch: edges
    SparseCheckpoint<64> checkpoint_;
};

}  // namespace nearfield::narrowphase
