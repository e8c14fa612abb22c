#pragma once

#include <engine/localize/hierarchy.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::localize {

/// Finds the pairs among many shapes whose boxes are close to each other: sort and sweep along the
/// axis on which the boxes are spread wider. Reuses its memory between calls.
class BroadPhase {
public:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    /// Replaces `pairs` by the indices of all shapes that can be at most `reach` apart, by
    /// may_meet(), the lower index first, in ascending order.
    void find(std::span<const Bounds> shapes, double reach, std::vector<Pair>& pairs);

private:
    /// Writes the pairs found in ascending order.
    void sort_found(std::size_t shapes, std::vector<Pair>& pairs);

    /// A box that is grown by half the reach and by more than the rounding of its vertices: its
    /// ends along the sweep axis, and along the other.
    struct Grown {
        double begin;
        double end;
        double low;
        double high;
    };

    std::vector<std::pair<double, std::uint32_t>> order_;  // where grown boxes begin, indices
    std::vector<Grown> sorted_;                            // in that order
    std::vector<Pair> found_;                              // in sweep order
    std::vector<std::uint32_t> ends_;                      // of each first box's pairs
};

}  // namespace nearfield::localize
