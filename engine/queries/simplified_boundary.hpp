#pragma once

#include <engine/geometry/simplify.hpp>
#include <engine/geometry/vector.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::queries {

/// A simplified boundary, ring after ring, under a hierarchy of boxes over consecutive edges, so
/// that the edges near a tile are found without visiting all. Coordinates are relative to the
/// shape's centre, so that one boundary serves every pose. Does not own its arrays.
struct SimplifiedBoundary {
    /// Edges per box of the lowest level, and boxes per box of every other level.
    static constexpr std::uint32_t fan_out = 4;

    const geometry::Polygon* polygon = nullptr;
    std::span<const geometry::SimplifiedEdge> edges;
    std::span<const std::uint32_t> ring_of;  ///< by edge
    std::span<const std::uint32_t>
        ring_begin;                        ///< by ring: its first edge; then the end of the last
    std::span<const geometry::Box> boxes;  ///< level by level, the lowest first, then the root

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(edges.size()); }
    /// The edge before `edge` on its ring.
    [[nodiscard]] std::uint32_t previous(std::uint32_t edge) const {
        const std::uint32_t ring = ring_of[edge];
        return (edge == ring_begin[ring] ? ring_begin[ring + 1] : edge) - 1;
    }

    /// Calls `visit(edge)`, in order, for the edges of every box of the lowest level that is
    /// entered along with all boxes above it. `enter(box, first, end)` decides whether to enter the
    /// box around the edges first, ..., end - 1.
    template <class Enter, class Visit>
    void traverse(Enter&& enter, Visit&& visit) const;

    /// Descends to the box with the smallest `distance(box)` at each level; returns the first edge
    /// of the box reached at the lowest level.
    template <class Distance>
    [[nodiscard]] std::uint32_t descend(Distance&& distance) const;

private:
    struct Levels {
        std::array<std::uint32_t, 16> start{};  // in boxes
        std::uint32_t top = 0;                  // the level of the root
    };
    [[nodiscard]] Levels levels() const {
        Levels levels;
        std::uint32_t count = (size() + fan_out - 1) / fan_out;
        while (count > 1) {
            levels.start[levels.top + 1] = levels.start[levels.top] + count;
            ++levels.top;
            count = (count + fan_out - 1) / fan_out;
        }
        return levels;
    }
};

/// Appends the boxes of a hierarchy over a polygon's simplified edges.
void append_boxes(const geometry::Polygon& polygon, std::span<const geometry::SimplifiedEdge> edges,
                  std::vector<geometry::Box>& boxes);

template <class Enter, class Visit>
void SimplifiedBoundary::traverse(Enter&& enter, Visit&& visit) const {
    const Levels tree = levels();
    std::uint32_t level = tree.top;
    std::uint64_t step = 1;  // edges per box of the level
    for (std::uint32_t i = 0; i <= level; ++i) {
        step *= fan_out;
    }
    std::uint64_t edge = 0;
    while (edge < size()) {
        const auto end = static_cast<std::uint32_t>(std::min<std::uint64_t>(edge + step, size()));
        const geometry::Box& box = boxes[tree.start[level] + edge / step];
        if (enter(box, static_cast<std::uint32_t>(edge), end)) {
            if (level > 0) {
                --level;
                step /= fan_out;
                continue;
            }
            for (auto i = static_cast<std::uint32_t>(edge); i < end; ++i) {
                visit(i);
            }
        }
        edge += step;
        while (level < tree.top && edge % (step * fan_out) == 0) {
            ++level;
            step *= fan_out;
        }
    }
}

template <class Distance>
std::uint32_t SimplifiedBoundary::descend(Distance&& distance) const {
    const Levels tree = levels();
    std::uint32_t place = 0;  // within its level
    for (std::uint32_t level = tree.top; level > 0; --level) {
        const std::uint32_t below = tree.start[level - 1];
        const std::uint32_t end = std::min(below + fan_out * (place + 1), tree.start[level]);
        std::uint32_t best = below + fan_out * place;
        double nearest = distance(boxes[best]);
        for (std::uint32_t i = best + 1; i < end; ++i) {
            if (const double other = distance(boxes[i]); other < nearest) {
                nearest = other;
                best = i;
            }
        }
        place = best - below;
    }
    return place * fan_out;
}

}  // namespace nearfield::queries
