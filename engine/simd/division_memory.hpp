#pragma once

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

}  // namespace nearfield::simd
