#pragma once

#include <engine/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::localize {

/// Finds the pairs among many boxes that are close to each other: sort and sweep along the axis on
/// which the boxes are spread wider. Reuses its memory between calls.
class BroadPhase {
public:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    /// Replaces `pairs` by the indices of all pairs of boxes at most `reach` apart along both axes
    /// (0: closed boxes that intersect), the lower index first, in ascending order.
    void find(std::span<const geometry::Box> boxes, double reach, std::vector<Pair>& pairs);

private:
    /// Writes the pairs found in ascending order.
    void sort_found(std::size_t boxes, std::vector<Pair>& pairs);

    /// A box grown by the reach: its low end along the sweep axis, and both ends along the other.
    struct Grown {
        double begin;
        double low;
        double high;
    };

    std::vector<std::pair<double, std::uint32_t>> order_;  // low ends along the axis, indices
    std::vector<Grown> sorted_;                            // in that order
    std::vector<Pair> found_;                              // in sweep order
    std::vector<std::uint32_t> ends_;                      // of each first box's pairs
};

}  // namespace nearfield::localize
