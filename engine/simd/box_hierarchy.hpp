#pragma once

#include <engine/geometry/vector.hpp>
#include <engine/simd/ordered_search.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nearfield::simd {

/// Calls `use(i)` for the boxes whose keys are at most `bound()`, which may fall, in ascending
/// order of their keys. Boxes that hold nothing are infinitely far away.
template <class Bound, class Use>
void for_nearest_first(const BoxKeys& keys, const Bound& bound, const Use& use) {
    constexpr double largest_key = 1e300;
    const double most = std::min(bound(), largest_key);
    std::uint32_t left = 0;
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        left |= (keys[i] <= most ? 1U : 0U) << i;
    }
    while (left != 0) {
        auto nearest = static_cast<std::uint32_t>(std::countr_zero(left));
        for (std::uint32_t others = left & (left - 1); others != 0; others &= others - 1) {
            const auto other = static_cast<std::uint32_t>(std::countr_zero(others));
            nearest = keys[other] < keys[nearest] ? other : nearest;
        }
        if (keys[nearest] > bound()) {
            return;
        }
        left &= ~(1U << nearest);
        use(nearest);
    }
}

/// Calls `use(edge)` for the edges in all boxes of some levels of a tree whose squared distance
/// from a box is at most `bound()`, which may fall; nearer boxes come first. `first`: of eight
/// boxes.
template <class Bound, class Use>
void for_edges_near(const AabbTree& tree, std::uint32_t level, std::uint32_t first,
                    const Extent& from, const Bound& bound, const Use& use) {
    BoxKeys keys;
    kernels::measure_boxes(tree.boxes(level, first), first, from, keys);
    for_nearest_first(keys, bound, [&](std::uint32_t i) {
        const std::uint32_t box = first + i;
        if (level > 0) {
            for_edges_near(tree, level - 1, AabbTree::fan_out * box, from, bound, use);
            return;
        }
        const EdgeRange range = tree.edges_of(box);
        for (std::uint32_t edge = range.first; edge < range.end; ++edge) {
            use(edge);
        }
    });
}
/// The same for the whole tree.
template <class Bound, class Use>
void for_edges_near(const AabbTree& tree, const Extent& from, const Bound& bound, const Use& use) {
    for_edges_near(tree, tree.top_level(), 0, from, bound, use);
}

/// A dynamic tree over many boxes, each named by a number of the caller's: eight boxes in one node,
/// tested together. A box that changes is refitted along its path to the root; once many changes
/// have made the nodes much larger, everything is ordered anew along a Hilbert curve.
class BoxHierarchy {
public:
    /// The name of no box.
    static constexpr std::uint32_t nowhere = UINT32_MAX;

    /// Adds a box, or replaces the one of that name. An empty box is never found.
    void set(std::uint32_t name, const geometry::Box& box);
    void remove(std::uint32_t name);
    /// Whether to order the boxes pays.
    [[nodiscard]] bool is_outdated() const {
        constexpr double too_large = 2.0;
        return levels_.empty() || size_ > too_large * size_when_built_;
    }
    /// Orders the boxes, if that pays. Searches do not change the tree, so several threads may
    /// search it at the same time.
    void prepare();
    /// Gives back all but the boxes; the tree is built again when it is needed.
    void trim();

    /// Calls `use(name)` for every box that intersects a closed box.
    template <class Use>
    void for_meeting(const geometry::Box& box, const Use& use) const {
        if (!levels_.empty()) {
            visit_meeting(top_level(), 0, geometry::extent_of(box), use);
        }
    }

    /// Calls `use(name, squared)` for boxes in roughly ascending order of their squared distance
    /// from a box, as long as that is at most `bound()`, which may fall.
    template <class Bound, class Use>
    void for_near(const geometry::Box& box, const Bound& bound, const Use& use) const {
        if (!levels_.empty()) {
            visit_near(top_level(), 0, geometry::extent_of(box), bound, use);
        }
    }

    // For searches of many paths at the same time. Precondition: it has boxes.

    [[nodiscard]] bool has_boxes() const { return !levels_.empty(); }
    [[nodiscard]] std::uint32_t top_level() const {
        return static_cast<std::uint32_t>(levels_.size()) - 1;
    }
    /// The number of nodes of a level. Their boxes are `doubles_per_node` from each other in
    /// memory.
    [[nodiscard]] std::size_t node_count(std::uint32_t level) const {
        return levels_[level].size();
    }
    static constexpr std::uint32_t doubles_per_node = 4 * AabbTree::fan_out;
    /// Eight boxes of a level; those under its box i are number i of the level below.
    [[nodiscard]] BoxArrays boxes(std::uint32_t level, std::uint32_t number) const {
        return levels_[level][number].boxes();
    }
    /// The name of a box of level 0, or `nowhere`.
    [[nodiscard]] std::uint32_t name(std::uint32_t box) const { return names_[box]; }

    [[nodiscard]] std::size_t bytes() const;

private:
    static constexpr std::uint32_t fan_out = AabbTree::fan_out;

    /// Eight boxes as a structure of arrays, in one piece of memory.
    struct alignas(64) Node {
        std::array<double, fan_out> low_x;
        std::array<double, fan_out> low_y;
        std::array<double, fan_out> high_x;
        std::array<double, fan_out> high_y;

        [[nodiscard]] BoxArrays boxes() const {
            return {fan_out, low_x.data(), low_y.data(), high_x.data(), high_y.data()};
        }
        void clear();
        void set(std::uint32_t box, const Extent& extent);
        [[nodiscard]] Extent at(std::uint32_t box) const;
    };
    using Level = std::vector<Node>;

    template <class Use>
    void visit_meeting(std::uint32_t level, std::uint32_t number, const Extent& extent,
                       const Use& use) const {
        BoxKeys keys;
        kernels::measure_boxes(levels_[level][number].boxes(), 0, extent, keys);
        for (std::uint32_t i = 0; i < fan_out; ++i) {
            if (keys[i] > 0.0) {
                continue;
            }
            if (level > 0) {
                visit_meeting(level - 1, fan_out * number + i, extent, use);
            } else if (names_[fan_out * number + i] != nowhere) {
                use(names_[fan_out * number + i]);
            }
        }
    }

    template <class Bound, class Use>
    void visit_near(std::uint32_t level, std::uint32_t number, const Extent& extent,
                    const Bound& bound, const Use& use) const {
        BoxKeys keys;
        kernels::measure_boxes(levels_[level][number].boxes(), 0, extent, keys);
        for_nearest_first(keys, bound, [&](std::uint32_t i) {
            if (level > 0) {
                visit_near(level - 1, fan_out * number + i, extent, bound, use);
            } else if (names_[fan_out * number + i] != nowhere) {
                use(names_[fan_out * number + i], keys[i]);
            }
        });
    }

    void build();
    void set_box(std::size_t level, std::uint32_t box, const Extent& extent);
    /// Writes the box over a node into the level above.
    void join(std::size_t level, std::uint32_t node);
    /// Makes the boxes above a lowest box fit again.
    void refit(std::uint32_t leaf);
    [[nodiscard]] double size_of_node(std::uint32_t node) const;

    std::vector<Level> levels_;          // the lowest first; none if it has to be built
    std::vector<std::uint32_t> names_;   // by lowest box; nowhere: unused
    std::vector<std::uint32_t> leaves_;  // by name; nowhere: none
    std::vector<std::uint32_t> free_;    // unused lowest boxes
    std::vector<Extent> boxes_;          // by name
    double size_ = 0.0;                  // of all nodes over lowest boxes, together
    double size_when_built_ = 0.0;
    // Scratch for building.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> on_curve_;
};

}  // namespace nearfield::simd
