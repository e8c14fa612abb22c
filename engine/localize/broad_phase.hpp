#pragma once

#include <engine/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::localize {

/// Finds the pairs among many boxes that are close to each other: sort and sweep along the axis on
/// which the boxes are spread wider. Keeps its memory from call to call.
class BroadPhase {
public:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    /// Replaces `pairs` by the positions of all pairs of boxes that are at most `reach` apart along
    /// both axes (0: closed boxes that meet), the lower position first, in ascending order.
    void find(std::span<const geometry::Box> boxes, double reach, std::vector<Pair>& pairs);

private:
    /// Writes what was found in ascending order.
    void sort_found(std::size_t boxes, std::vector<Pair>& pairs);

    /// Of a box, grown by the reach: where it begins along the axis, and its ends along the other.
    struct Grown {
        double begin;
        double low;
        double high;
    };

    std::vector<std::pair<double, std::uint32_t>> order_;  // low ends along the axis, positions
    std::vector<Grown> sorted_;                            // in that order
    std::vector<Pair> found_;                              // as they came up
    std::vector<std::uint32_t> ends_;                      // of the pairs of each first box
};

}  // namespace nearfield::localize
