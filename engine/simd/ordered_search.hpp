#pragma once

#include <engine/simd/aabb_tree.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

/// \file
/// Searches of trees from the nearest box on, with a bound that falls as something is found.

namespace nearfield::simd {

/// A straight path from one point to another; parameter 0 is the start, 1 the end.
struct Path {
    double from_x = 0.0;
    double from_y = 0.0;
    double to_x = 0.0;
    double to_y = 0.0;
};

/// Receives edges, and returns the bound of the search from then on, which must not rise.
using BoundedEdgeSink = FunctionRef<double(std::uint32_t)>;

/// Up to this many edges are tested together against each box of a tree.
inline constexpr std::uint32_t max_few_edges = 32;

/// A shape of at most that many edges, with inverse lengths.
struct FewEdges {
    const EdgeArrays& edges;
    Extent box;  ///< around them
    /// Of at most unit length: the nearer it is to the direction towards the closest edge of
    /// others, the fewer of those are looked at. (0, 0) if nothing is known.
    double direction[2];
};

/// As VertexAndEdge, with the squared distance that geometry::nearest_on_segment() computes.
struct NearPair : VertexAndEdge {
    double exact = 0.0;
};

/// Receives the results of a search.
using NearPairSink = FunctionRef<void(const NearPair&)>;

/// One number for each of eight boxes.
using BoxKeys = std::array<double, AabbTree::fan_out>;

/// 1 / the extent of a path along each axis; large where there is none.
struct PathInverse {
    double x;
    double y;

    explicit PathInverse(const Path& path)
        : x(of(path.to_x - path.from_x)), y(of(path.to_y - path.from_y)) {}

private:
    /// Finite, so that its product with zero is zero.
    static double of(double extent) {
        constexpr double smallest = 1e-300;
        return extent > smallest || extent < -smallest ? 1.0 / extent : 1.0 / smallest;
    }
};

/// What a path comes to next: groups of eight boxes, or the edges of a lowest box.
struct PathStep {
    static constexpr std::uint32_t max_groups = 4;

    Path path;
    PathInverse inverse{path};
    double margin = 0.0;
    double bound = 1.0;              ///< largest parameter of interest; at most 1
    std::uint32_t groups = 0;        ///< of boxes, at most max_groups; 0: edges are tested
    std::uint32_t group_stride = 0;  ///< from one group to the next
    const double* low_x = nullptr;   ///< of the boxes; their low y, high x and high y follow ...
    std::size_t stride = 0;          ///< ... at this distance from each other
    /// Receives the parameters at which the path enters the boxes, for max_groups groups.
    double* keys = nullptr;
    const EdgeArrays* edges = nullptr;
    EdgeRange range;  ///< of the edges
    // Found:
    std::uint32_t met = 0;      ///< one bit per box, or edge, that the path may meet
    std::uint32_t nearest = 0;  ///< of the boxes met, the one that the path enters first
};

/// Numbers of paths, listed by what their next steps test, so that no branch depends on that.
struct PathLists {
    static constexpr std::size_t max_paths = 24;
    enum Kind : std::uint32_t { edges, one_group, groups, kinds };

    std::array<std::array<std::uint32_t, max_paths>, kinds> numbers;
    std::array<std::uint32_t, kinds> counts = {};

    void add(std::uint32_t number, const PathStep& step) {
        const std::uint32_t kind = std::min(step.groups, std::uint32_t{groups});
        numbers[kind][counts[kind]++] = number;
    }
    [[nodiscard]] std::span<const std::uint32_t> of(Kind kind) const {
        return std::span(numbers[kind]).first(counts[kind]);
    }
    [[nodiscard]] bool empty() const {
        return std::all_of(counts.begin(), counts.end(), [](std::uint32_t n) { return n == 0; });
    }
};

namespace kernels {

/// Calls `sink` for every edge whose squared distance from a point is at most the bound, up to
/// rounding; begins with `bound`.
void for_edges_near(const AabbTree& tree, double x, double y, double bound,
                    const BoundedEdgeSink& sink);

/// As for_closest(), for a shape of few edges instead of a first tree. The order is from the
/// nearest box on, so the bound falls quickly. `margin`: covers the rounding of all vertices, too.
double for_closest_to_few(const FewEdges& few, const AabbTree& tree, double most, double margin,
                          const NearPairSink& sink);

/// Writes the squared distances of eight boxes from a box.
void measure_boxes(const BoxArrays& boxes, std::uint32_t first, const Extent& from,
                   BoxKeys& squared);

/// Takes one step of each path listed: finds the boxes that it comes within twice the margin of at
/// a parameter of at most the bound, or the edges that it may come within the margin of.
void take_steps(std::span<PathStep> steps, const PathLists& paths);

/// Returns the bounding box of eight boxes.
[[nodiscard]] Extent join_boxes(const BoxArrays& boxes, std::uint32_t first);

}  // namespace kernels

}  // namespace nearfield::simd
