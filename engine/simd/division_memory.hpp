#pragma once

#include <engine/simd/edge_kernels.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace nearfield::simd {

/// Lists for searches that divide points and edges again and again: one list of indices and one of
/// numbers per depth of the division. Grows, and keeps its memory.
class DivisionMemory {
public:
    /// A list with room for `count` entries and one vector more; valid until it is asked for again.
    [[nodiscard]] std::uint32_t* list(std::size_t depth, std::size_t count);
    [[nodiscard]] double* numbers(std::size_t depth, std::size_t count);

private:
    std::deque<std::vector<std::uint32_t>> lists_;
    std::deque<std::vector<double>> numbers_;
};

/// The box of the chosen points. Precondition: there is one.
[[nodiscard]] Extent extent_of_points(const double* x, const double* y, const std::uint32_t* chosen,
                                      std::uint32_t count);

/// Orders the chosen points so that the first half lies before the others along the longer side of
/// their box; returns the size of that half.
[[nodiscard]] std::uint32_t halve(const double* x, const double* y, const Extent& box,
                                  std::uint32_t* chosen, std::uint32_t count);

}  // namespace nearfield::simd
