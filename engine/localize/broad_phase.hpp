#pragma once

#include <engine/geometry/vector.hpp>

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
    std::vector<std::uint32_t> order_;   // positions by low end along the axis
    std::vector<geometry::Box> sorted_;  // in that order
};

}  // namespace nearfield::localize
