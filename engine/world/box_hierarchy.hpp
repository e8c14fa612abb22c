#pragma once

#include <engine/geometry/vector.hpp>
#include <engine/simd/ordered_search.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::world {

/// A dynamic tree over many boxes, each named by a number of the caller's: eight boxes in one node,
/// tested together. A box that changes is refitted along its path to the root; once many changes
/// have made the nodes much larger, everything is ordered anew along a Hilbert curve.
class BoxHierarchy {
public:
    /// Adds a box, or replaces the one of that name. An empty box is never found.
    void set(std::uint32_t name, const geometry::Box& box);
    void remove(std::uint32_t name);
    /// Orders the boxes, if that pays. Searches do not change the tree, so several threads may
    /// search it at the same time.
    void prepare();
    void clear();

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
        const simd::Extent extent = geometry::extent_of(box);
        search(
            [&](const simd::BoxArrays& boxes, std::uint32_t first, simd::BoxKeys& keys) {
                simd::kernels::measure_boxes(boxes, first, extent, keys);
            },
            bound, use);
    }

    /// Calls `use(name, parameter)` for boxes that a path comes within `margin` of, in roughly
    /// ascending order of the parameter, as long as that is at most `bound()`, which may fall.
    template <class Bound, class Use>
    void for_along(const simd::Path& path, double margin, const Bound& bound,
                   const Use& use) const {
        search(
            [&](const simd::BoxArrays& boxes, std::uint32_t first, simd::BoxKeys& keys) {
                simd::kernels::enter_boxes(boxes, first, path, margin, keys);
            },
            bound, use);
    }

    [[nodiscard]] std::size_t bytes() const;

private:
    static constexpr std::uint32_t fan_out = simd::AabbTree::fan_out;
    static constexpr std::uint32_t nowhere = UINT32_MAX;

    /// Boxes as a structure of arrays, whole nodes of eight.
    struct Level {
        std::vector<double> sides;  // low x of all, then low y, high x, high y
        std::uint32_t count = 0;

        [[nodiscard]] simd::BoxArrays arrays() const;
        void resize(std::uint32_t boxes);
        void set(std::uint32_t box, const simd::Extent& extent);
        [[nodiscard]] simd::Extent at(std::uint32_t box) const;
    };

    template <class Measure, class Bound, class Use>
    void search(const Measure& measure, const Bound& bound, const Use& use) const {
        if (!levels_.empty()) {
            visit(top_level(), 0, measure, bound, use);
        }
    }

    [[nodiscard]] std::uint32_t top_level() const {
        return static_cast<std::uint32_t>(levels_.size()) - 1;
    }

    template <class Use>
    void visit_meeting(std::uint32_t level, std::uint32_t first, const simd::Extent& extent,
                       const Use& use) const {
        simd::BoxKeys keys;
        simd::kernels::measure_boxes(levels_[level].arrays(), first, extent, keys);
        for (std::uint32_t i = 0; i < fan_out; ++i) {
            if (keys[i] > 0.0) {
                continue;
            }
            if (level > 0) {
                visit_meeting(level - 1, fan_out * (first + i), extent, use);
            } else if (names_[first + i] != nowhere) {
                use(names_[first + i]);
            }
        }
    }

    template <class Measure, class Bound, class Use>
    void visit(std::uint32_t level, std::uint32_t first, const Measure& measure, const Bound& bound,
               const Use& use) const {
        simd::BoxKeys keys;
        measure(levels_[level].arrays(), first, keys);
        for (std::uint32_t left = fan_out; left > 0; --left) {
            std::uint32_t nearest = 0;
            for (std::uint32_t i = 1; i < fan_out; ++i) {
                nearest = keys[i] < keys[nearest] ? i : nearest;
            }
            if (!(keys[nearest] <= bound()) || keys[nearest] > largest_key) {
                return;
            }
            const double key = keys[nearest];
            keys[nearest] = 2.0 * largest_key;
            if (level > 0) {
                visit(level - 1, fan_out * (first + nearest), measure, bound, use);
            } else if (names_[first + nearest] != nowhere) {
                use(names_[first + nearest], key);
            }
        }
    }

    /// Keys above this are those of boxes that hold nothing, or that were already visited.
    static constexpr double largest_key = 1e300;

    void build();
    /// Makes the boxes above a lowest box fit again.
    void refit(std::uint32_t leaf);
    [[nodiscard]] double size_of_node(std::uint32_t node) const;

    std::vector<Level> levels_;          // the lowest first; none if it has to be built
    std::vector<std::uint32_t> names_;   // by lowest box; nowhere: unused
    std::vector<std::uint32_t> leaves_;  // by name; nowhere: none
    std::vector<std::uint32_t> free_;    // unused lowest boxes
    std::vector<simd::Extent> boxes_;    // by name
    double size_ = 0.0;                  // of all nodes over lowest boxes, together
    double size_when_built_ = 0.0;
    // Scratch for building.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> on_curve_;
};

}  // namespace nearfield::world
