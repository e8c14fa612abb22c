#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/nearest_points.hpp>
#include <engine/exact/placed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// The point farthest from a boundary, of several.
struct DeepestPoint {
    std::uint32_t count = 0;  ///< of the points that are not on the boundary
    std::uint32_t point = 0;  ///< of equally deep ones the first; none where the count is 0
    NearestOfEdges nearest;   ///< the edge nearest to it; how far others are may be left open (0)
};

/// Finds which of some points is farthest from a placed polygon's boundary. How deep two points are
/// differs by no more than the way between them, so of many points that follow each other closely
/// most need no look. Keeps its memory.
class DeepestPointFinder {
public:
    /// Points nearer to the boundary than `touching` are on it. `margin`: of uniqueness, see
    /// Boundary::is_unique(). Points have the room behind them that kernels need; edges are small
    /// or complete.
    [[nodiscard]] DeepestPoint find(const PointArrays& points, const PlacedEdges& edges,
                                    double touching, double margin);

private:
    /// How deep a point is.
    struct Sounding {
        std::uint32_t point;
        double depth;
    };
    /// Of so many points that follow each other the first is sounded before any other.
    static constexpr std::uint32_t stride = 32;

    void find_together(double margin);
    void find_by_soundings();

    [[nodiscard]] Sounding sound(std::uint32_t point);
    /// Counts a point, and takes it where it is deeper. `edge`: nearest to it.
    void take(std::uint32_t point, double depth, std::uint32_t edge);
    /// Looks between two points, which were sounded, as far as it takes. `way`: along the points up
    /// to each, counted from `origin`.
    void search_between(const Sounding& low, const Sounding& high, const double* way,
                        std::uint32_t origin);
    /// At a few points together.
    void look_between(std::uint32_t first, std::uint32_t end);

    PointArrays points_;
    const PlacedEdges* edges_ = nullptr;
    double touching_ = 0.0;
    double depth_ = 0.0;  // of the deepest so far
    DeepestPoint deepest_;
    Boundary boundary_;        // of edges that are not small
    NearestPoints nearest_;    // to the points
    std::uint32_t guess_ = 0;  // an edge near the points sounded last
    std::vector<Sounding> soundings_;
};

}  // namespace nearfield::exact
