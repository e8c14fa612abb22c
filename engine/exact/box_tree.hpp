#pragma once

#include <engine/exact/edge_kernels.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

/// Edges that follow each other in their arrays.
struct EdgeRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

/// Boxes over every eight edges that follow each other in their arrays, over every eight of those
/// boxes, and so on up to eight or fewer: hardly more than their coordinates is kept, so that
/// building them anew each frame is one pass over the edges, and eight are looked at together.
///
/// Of few rings where one begins does not count: its edges share a box with the last of the ring
/// before. Many rings, which may come in any order, are cut into pieces of up to eight edges; the
/// lowest boxes are over those, rings that are near each other next to each other.
class BoxTree {
public:
    static constexpr std::uint32_t fan_out = 8;

    /// How many boxes there are over so many edges, or over so many boxes.
    [[nodiscard]] static constexpr std::uint32_t boxes_over(std::uint32_t count) {
        return count / fan_out + (count % fan_out != 0 ? 1 : 0);
    }
    /// How many doubles the boxes take, with so many lowest ones, and what is kept with them.
    [[nodiscard]] static std::size_t room(std::uint32_t lowest);

    /// A view of edges and of the boxes over them, which kernels::find_boxes() wrote after the
    /// places of ring_starts(): first x, then y, each with room for whole lanes. `pieces`: one a
    /// lowest box; none where these are over every eight edges.
    BoxTree(const EdgeArrays& edges, std::span<const EdgeRange> pieces, const double* boxes);

    [[nodiscard]] const EdgeArrays& edges() const { return edges_; }
    /// True where the lowest boxes come in the order of the edges.
    [[nodiscard]] bool is_in_order() const { return pieces_.empty(); }
    /// What a lowest box is over: at least one edge.
    [[nodiscard]] EdgeRange edges_of(std::uint32_t box) const {
        if (!pieces_.empty()) {
            return pieces_[box];
        }
        const std::uint32_t first = fan_out * box;
        return {first, edges_.count - first < fan_out ? edges_.count : first + fan_out};
    }
    /// The lowest, 0, are boxes over edges.
    [[nodiscard]] std::uint32_t top_level() const { return top_level_; }
    [[nodiscard]] const BoxArrays& level(std::uint32_t level) const { return levels_[level]; }
    /// For each of the lowest boxes where the ring begins that its first edge is of.
    [[nodiscard]] const PointArrays& ring_starts() const { return ring_starts_; }

private:
    static constexpr std::size_t most_levels = 10;  // over more edges than 32 bits can count

    EdgeArrays edges_;
    std::span<const EdgeRange> pieces_;
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
    bool (*use)(void* user, const VertexAndEdge& found) = nullptr;
    void* user = nullptr;
};

namespace kernels {

// As their namesakes of edge_kernels.hpp, but inverse lengths are not read. Where there are pieces,
// arrays of edges may be read, not used, up to a vector more than whole lanes.

/// Writes the boxes of a BoxTree, not its ring starts.
void find_boxes(const EdgeArrays& edges, std::span<const EdgeRange> pieces, double* boxes);

/// True where an even-odd ray says so, as contain().
[[nodiscard]] bool contain(const BoxTree& tree, double x, double y);

/// Where a ray starts and which way it goes.
struct Ray {
    double x = 0.0;
    double y = 0.0;
    bool upwards = false;  ///< else to the right
};

/// The line of an edge that a ray starts on.
struct LineOfEdge {
    double along_x = 0.0;
    double along_y = 0.0;
    double rounding = 0.0;  ///< what vertices and the ray's start may be off by
};

/// True where a ray crosses an odd number of edges.
[[nodiscard]] bool crossings_are_odd(const BoxTree& tree, const Ray& ray);

/// The same of all edges but those that run along a line through the ray's start: the edge that it
/// starts on, and others where that lies on them too. Precondition: the ray leaves the line at an
/// angle of 45 degrees or more.
[[nodiscard]] bool crossings_of_others_are_odd(const BoxTree& tree, const Ray& ray,
                                               const LineOfEdge& line);

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
/// far, until it says no. Precondition: some are no farther apart than the root of `most`. Returns
/// the square of the least distance so far.
double for_closest(const BoxTree& first, const BoxTree& second, double most, double margin,
                   const VertexAndEdgeSink& sink);

/// Calls `sink` for every vertex of either shape and edge of the other whose squared distance is up
/// to rounding at most `most`, until it says no; returns whether it did.
bool for_within(const BoxTree& first, const BoxTree& second, double most,
                const VertexAndEdgeSink& sink);

}  // namespace kernels

}  // namespace nearfield::exact
