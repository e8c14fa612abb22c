#pragma once

#include <engine/base/function_ref.hpp>
#include <engine/simd/edge_kernels.hpp>
#include <engine/simd/edges_on_demand.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nearfield::simd {

/// Boxes as a structure of arrays, one per side. Arrays are padded to a multiple of eight with a
/// box that intersects nothing.
struct BoxArrays {
    std::uint32_t count = 0;
    const double* low_x = nullptr;
    const double* low_y = nullptr;
    const double* high_x = nullptr;
    const double* high_y = nullptr;
};

/// Consecutive edges in their arrays.
struct EdgeRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

/// An AABB tree with fan-out eight: one box over every eight consecutive edges, one over every
/// eight of those boxes, and so on up to a level of eight or fewer. It stores little more than the
/// coordinates, so building it each frame takes one pass over the edges, and eight boxes are tested
/// together. Where edges and boxes are placed on demand, a search calls boxes() and edges_of() for
/// what it is going to look at.
///
/// With few rings, ring boundaries are ignored: a box may hold the end of one ring and the start of
/// the next. Many rings, which may come in any order, are cut into pieces of up to eight edges; the
/// lowest boxes are over those, with nearby rings next to each other.
class AabbTree {
public:
    static constexpr std::uint32_t fan_out = 8;

    /// Returns the number of boxes one level above `count` edges or boxes.
    [[nodiscard]] static constexpr std::uint32_t boxes_over(std::uint32_t count) {
        return count / fan_out + (count % fan_out != 0 ? 1 : 0);
    }
    /// Returns the number of doubles needed for the boxes and the data kept with them, for the
    /// given number of lowest boxes.
    [[nodiscard]] static std::size_t room(std::uint32_t lowest);

    /// A view of edges and of the boxes over them, which kernels::find_boxes() wrote after the
    /// arrays of ring_starts(): first x, then y, each padded to whole lanes. `pieces`: one per
    /// lowest box; empty if the boxes are over every eight edges. `on_demand`: fills the arrays of
    /// edges and boxes, if they are not filled yet; there are no ring starts then.
    AabbTree(const EdgeArrays& edges, std::span<const EdgeRange> pieces, const double* boxes,
             const EdgesOnDemand* on_demand = nullptr);

    /// Of which those are placed that edges_of() has returned.
    [[nodiscard]] const EdgeArrays& edges() const { return edges_; }
    /// The same, with all of them placed.
    [[nodiscard]] const EdgeArrays& all_edges() const {
        if (on_demand_ != nullptr) {
            on_demand_->place_all();
        }
        return edges_;
    }
    /// True if the lowest boxes come in the order of the edges.
    [[nodiscard]] bool is_in_order() const { return pieces_.empty(); }
    /// The edges of a lowest box, placed; at least one.
    [[nodiscard]] EdgeRange edges_of(std::uint32_t box) const {
        if (on_demand_ != nullptr) {
            on_demand_->place_edges(box);
        }
        if (!pieces_.empty()) {
            return pieces_[box];
        }
        const std::uint32_t first = fan_out * box;
        return {first, edges_.count - first < fan_out ? edges_.count : first + fan_out};
    }
    /// Level 0, the lowest, has the boxes over edges.
    [[nodiscard]] std::uint32_t top_level() const { return top_level_; }
    [[nodiscard]] std::uint32_t count(std::uint32_t level) const { return levels_[level].count; }
    /// The boxes of a level, of which the eight from `first` on, a multiple of eight, are placed.
    [[nodiscard]] const BoxArrays& boxes(std::uint32_t level, std::uint32_t first) const {
        if (on_demand_ != nullptr) {
            on_demand_->place_boxes(level, first / fan_out);
        }
        return levels_[level];
    }
    /// One box, placed.
    [[nodiscard]] Extent box(std::uint32_t level, std::uint32_t i) const {
        const BoxArrays& all = boxes(level, i / fan_out * fan_out);
        return {all.low_x[i], all.low_y[i], all.high_x[i], all.high_y[i]};
    }
    /// The corners of a box, or of a smaller one that is not along the axes.
    [[nodiscard]] std::array<geometry::Vector, 4> corners(std::uint32_t level,
                                                          std::uint32_t i) const;
    /// Null if all edges and boxes are there.
    [[nodiscard]] const EdgesOnDemand* on_demand() const { return on_demand_; }
    /// The start of the ring that the first edge of a lowest box belongs to: one coordinate.
    [[nodiscard]] double ring_start(std::uint32_t box, bool is_y) const {
        if (on_demand_ != nullptr) {
            return (is_y ? edges_.start_y : edges_.start_x)[on_demand_->ring_begin(box)];
        }
        return (is_y ? ring_starts_.y : ring_starts_.x)[box];
    }

private:
    static constexpr std::size_t max_levels = 10;  // enough for more edges than 32 bits can count

    EdgeArrays edges_;
    std::span<const EdgeRange> pieces_;
    PointArrays ring_starts_;
    const EdgesOnDemand* on_demand_;
    std::array<BoxArrays, max_levels> levels_;
    std::uint32_t top_level_ = 0;
};

/// How many more groups of eight boxes, or pairs of boxes, a search may look at. At 0 it has given
/// up, and its answer is not complete.
struct VisitsLeft {
    std::uint32_t count = ~0U;
};

/// Whether searches of a tree are worth trying: after one that gave up, the next ones probably do
/// too, so one is skipped, and more each time.
class SearchTrials {
public:
    /// True if the next search is to be skipped.
    [[nodiscard]] bool skip() {
        if (skip_ == 0) {
            return false;
        }
        --skip_;
        return true;
    }
    void record(bool gave_up) {
        skipped_ = gave_up ? std::min(2 * skipped_ + 1, most_skipped) : 0;
        skip_ = skipped_;
    }

private:
    static constexpr std::uint32_t most_skipped = 63;
    std::uint32_t skipped_ = 0;
    std::uint32_t skip_ = 0;  // how many more
};

/// A vertex (the start of an edge) and a nearby edge of the other shape.
struct VertexAndEdge {
    std::uint32_t vertex = 0;
    std::uint32_t edge = 0;
    bool vertex_of_first = true;
    double squared = 0.0;  ///< their squared distance, up to rounding
};

/// Each receives the results of a pair search, and returns whether to go on.
using EdgePairSink = FunctionRef<bool(const EdgePair&)>;
using VertexAndEdgeSink = FunctionRef<bool(const VertexAndEdge&)>;

namespace kernels {

// As their namesakes in edge_kernels.hpp, but inverse lengths are not read. If there are pieces,
// kernels may read (but not use) up to one vector beyond the padded edge arrays.

/// Writes the boxes of an AabbTree, but not its ring starts.
void find_boxes(const EdgeArrays& edges, std::span<const EdgeRange> pieces, double* boxes);

/// True if the point is inside by the even-odd rule, as contain().
[[nodiscard]] bool contain(const AabbTree& tree, double x, double y);

/// Returns the nearest of the edges that are nearer to a point than `guess`, or `guess` if none is.
[[nodiscard]] NearEdge find_nearer(const AabbTree& tree, double x, double y, const NearEdge& guess);

[[nodiscard]] std::uint32_t find_edges_within(const AabbTree& tree, double x, double y, double most,
                                              std::uint32_t* found);

[[nodiscard]] std::uint32_t find_edges_in(const AabbTree& tree, const Extent& box,
                                          std::uint32_t* found);

/// Lists edges whose boxes intersect a box: all that come within `reach` of an edge of `others`. Up
/// to eight edges in one lowest box are rejected together.
[[nodiscard]] std::uint32_t find_edges_near(const AabbTree& tree, const Extent& box,
                                            const AabbTree& others, double reach,
                                            std::uint32_t* found);

/// True if the box of any edge intersects a box.
[[nodiscard]] bool meets(const AabbTree& tree, const Extent& box);

/// Calls `sink` for all pairs of edges that may be at most `margin` apart, until it returns false;
/// returns whether it did.
bool for_candidate_pairs(const AabbTree& first, const AabbTree& second, double margin,
                         const EdgePairSink& sink, VisitsLeft& left);

/// Calls `sink` for every vertex of either shape and edge of the other whose distance is at most
/// `margin` above the minimum, up to rounding, and for others that were the closest so far, until
/// it returns false. Precondition: some pair is no farther apart than the square root of `most`.
/// Returns the square of the least distance so far.
double for_closest(const AabbTree& first, const AabbTree& second, double most, double margin,
                   const VertexAndEdgeSink& sink);

/// Calls `sink` for every vertex of either shape and edge of the other whose squared distance is at
/// most `most`, up to rounding, until it returns false; returns whether it did.
bool for_within(const AabbTree& first, const AabbTree& second, double most,
                const VertexAndEdgeSink& sink);

}  // namespace kernels

}  // namespace nearfield::simd
