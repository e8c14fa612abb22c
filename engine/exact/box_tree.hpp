#pragma once

#include <engine/exact/edge_kernels.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nearfield::exact {

/// Boxes, an array for each side. What fills an array up to a multiple of eight is a box that
/// nothing meets.
struct BoxArrays {
    std::uint32_t count = 0;
    const double* low_x = nullptr;
    const double* low_y = nullptr;
    const double* high_x = nullptr;
    const double* high_y = nullptr;
};

/// Boxes over every eight edges that follow each other in their arrays, over every eight of those
/// boxes, and so on up to eight or fewer: hardly more than their coordinates is kept, so that
/// building them anew each frame is one pass over the edges, and eight are looked at together. Rings
/// do not count: where one begins its edges share a box with the last of the ring before.
class BoxTree {
public:
    static constexpr std::uint32_t fan_out = 8;

    /// How many doubles the boxes over so many edges take, and what is kept with them.
    [[nodiscard]] static std::size_t room(std::uint32_t edges);

    /// A view of edges and of the boxes over them, which kernels::find_boxes() wrote after the
    /// places of ring_starts(): first x, then y, each with room for whole lanes.
    BoxTree(const EdgeArrays& edges, const double* boxes);

    [[nodiscard]] const EdgeArrays& edges() const { return edges_; }
    /// The lowest, 0, are boxes over edges.
    [[nodiscard]] std::uint32_t top_level() const { return top_level_; }
    [[nodiscard]] const BoxArrays& level(std::uint32_t level) const { return levels_[level]; }
    /// For each of the lowest boxes where the ring begins that its first edge is of.
    [[nodiscard]] const PointArrays& ring_starts() const { return ring_starts_; }

private:
    static constexpr std::size_t most_levels = 10;  // over more edges than 32 bits can count

    EdgeArrays edges_;
    PointArrays ring_starts_;
    std::array<BoxArrays, most_levels> levels_;
    std::uint32_t top_level_ = 0;
};

/// A vertex (or where an edge starts) and an edge of the other shape near it.
struct VertexAndEdge {
    std::uint32_t vertex = 0;
    std::uint32_t edge = 0;
    bool vertex_of_first = true;
    double squared = 0.0;  ///< their distance, up to rounding
};

/// What a search by pairs calls with what it finds. `use` says whether to go on.
struct EdgePairSink {
    bool (*use)(void* user, const EdgePair& pair) = nullptr;
    void* user = nullptr;
};
struct VertexAndEdgeSink {
    void (*use)(void* user, const VertexAndEdge& found) = nullptr;
    void* user = nullptr;
};

namespace kernels {

// As their namesakes of edge_kernels.hpp, but inverse lengths are not read, and what fills up the
// arrays of edges is an edge of no length at the last edge's end.

/// Writes the boxes of a BoxTree, not its ring starts.
void find_boxes(const EdgeArrays& edges, double* boxes);

/// True where an even-odd ray says so, as contain().
[[nodiscard]] bool contain(const BoxTree& tree, double x, double y);

/// True where the ray from a point to the right, or upwards, crosses an odd number of edges other
/// than one, on which the point may lie.
[[nodiscard]] bool crossings_are_odd(const BoxTree& tree, double x, double y, bool upwards,
                                     std::uint32_t left_out);

/// An edge nearer to a point than `guess`, the nearest of them, or `guess` where there is none.
[[nodiscard]] NearEdge find_nearer(const BoxTree& tree, double x, double y, const NearEdge& guess);

[[nodiscard]] std::uint32_t find_edges_within(const BoxTree& tree, double x, double y, double most,
                                              std::uint32_t* found);

[[nodiscard]] std::uint32_t find_edges_in(const BoxTree& tree, const Extent& box,
                                          std::uint32_t* found);

/// Lists edges whose boxes meet a box: all that come as close to an edge of others as `reach`.
/// Eight that share a lowest box are left out together.
[[nodiscard]] std::uint32_t find_edges_near(const BoxTree& tree, const Extent& box,
                                            const BoxTree& others, double reach,
                                            std::uint32_t* found);

/// True where the box of an edge meets a box.
[[nodiscard]] bool meets(const BoxTree& tree, const Extent& box);

/// Calls `sink` for all pairs of edges that may come as close together as `margin`, until it says
/// no; returns whether it did.
bool for_meeting_pairs(const BoxTree& first, const BoxTree& second, double margin,
                       const EdgePairSink& sink);

/// Calls `sink` for every vertex of either shape and edge of the other whose distance is no more
/// than `margin` above the least of all, up to rounding, and for others that were the closest so
/// far. Precondition: some are no farther apart than the root of `most`. Returns the square of the
/// least distance.
double for_closest(const BoxTree& first, const BoxTree& second, double most, double margin,
                   const VertexAndEdgeSink& sink);

}  // namespace kernels

}  // namespace nearfield::exact
