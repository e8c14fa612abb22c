#pragma once

#include <engine/world/instances.hpp>
#include <nearfield/world.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::world {

/// Finds what segments hit. For one thread; several objects may work on one world at the same time.
/// Keeps its memory.
///
/// Several segments are followed at the same time, one step of each in turn: while one waits for
/// memory, or for what its last step found, the processor works for the others.
class RayQueries {
public:
    /// The instances have to be prepared.
    void begin(const Instances& instances, const WorldFilter& filter);

    /// Writes the first hit of each segment whose number is listed to hits[number].
    void find_first(std::span<const Segment> segments, std::span<const std::uint32_t> numbers,
                    std::span<RayHit> hits);
    /// Appends all hits, in order along the segment.
    void find_all(const Segment& segment, std::vector<RayHit>& hits);

private:
    /// An edge that the segment hits.
    struct Found {
        double parameter;
        std::uint64_t number;  // of the instance
        std::uint32_t instance;
        std::uint32_t edge;

        [[nodiscard]] bool operator<(const Found& other) const {
            return parameter != other.parameter ? parameter < other.parameter
                   : number != other.number     ? number < other.number
                                                : edge < other.edge;
        }
    };

    /// The parameters at which a segment enters boxes.
    struct alignas(64) Keys {
        std::array<double, std::size_t{simd::PathStep::max_groups} * simd::AabbTree::fan_out> of;
    };
    /// Boxes that a segment enters later. Their keys have the same index.
    struct Later {
        std::uint32_t left;   // one bit per box
        std::uint32_t first;  // of the boxes
        std::uint32_t level;
        bool are_instances;  // of the world's hierarchy, not of an instance's tree
    };
    /// Where searches of the world's hierarchy begin: with all boxes of a level of few groups.
    struct Top {
        std::uint32_t level = 0;
        std::uint32_t groups = 0;
    };
    /// Levels of a world's hierarchy and of an instance's tree.
    static constexpr std::size_t max_levels = 24;

    /// A segment that is being followed.
    struct Search {
        // Where it is now: a level of an instance's tree, or of the world's hierarchy.
        const simd::TransformedEdges* edges = nullptr;  // null: in the hierarchy
        const simd::AabbTree* tree = nullptr;
        std::uint32_t instance = 0;
        std::uint32_t level = 0;
        std::uint32_t first = 0;  // of the boxes looked at
        std::uint32_t later_count = 0;
        std::uint32_t number = 0;
        bool has_found = false;
        Found found = {};  // the first
        double rounding = 0.0;
        Keys* keys = nullptr;
        std::array<Later, max_levels> later = {};  // later_count of them
    };

    /// Begins to follow a segment.
    void start(Search& search, simd::PathStep& step, const Segment& segment, std::uint32_t number);
    /// Returns the box to enter, or `nowhere`, and keeps the others for later.
    [[nodiscard]] std::uint32_t use_boxes(Search& search, const simd::PathStep& step) const;
    void use_edges(Search& search, simd::PathStep& step);
    /// Prepares the step into a box or, if that is `nowhere`, into one of those kept; returns false
    /// at the end.
    [[nodiscard]] bool go_on(Search& search, simd::PathStep& step, std::uint32_t box) const;
    /// Prepares the step into a box; returns false if there is nothing in it.
    [[nodiscard]] bool enter(Search& search, simd::PathStep& step, std::uint32_t box) const;
    /// Returns the next box to enter, or `nowhere`.
    [[nodiscard]] std::uint32_t take_later(Search& search, simd::PathStep& step) const;
    void take(Search& search, const Found& found);
    /// Every member of the hit: to write them in place is quicker than to copy a hit.
    void write(const Search& search, const simd::Path& path, const Found& found, RayHit& hit) const;
    /// Makes room for that many segments at the same time.
    void reserve(std::size_t count);

    const Instances* instances_ = nullptr;
    WorldFilter filter_;
    Top top_;
    bool all_ = false;
    std::vector<Search> searches_;
    std::vector<simd::PathStep> steps_;  // of the searches
    std::vector<Keys> keys_;             // max_levels of each search
    std::vector<Found> all_found_;
};

}  // namespace nearfield::world
