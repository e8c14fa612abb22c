#pragma once

#include <algorithm>
#include <cstdint>

namespace nearfield::mtv {

/// Counts work, in comparisons of an edge with an edge, a point or a line, and reports when the
/// limit is reached.
class WorkBudget {
public:
    explicit WorkBudget(std::uint64_t most = 0) : most_(most) {}

    void add(std::uint64_t work) { used_ += work; }
    [[nodiscard]] std::uint64_t used() const { return used_; }
    [[nodiscard]] std::uint64_t left() const { return most_ - std::min(most_, used_); }
    [[nodiscard]] bool is_used_up() const { return used_ >= most_; }

private:
    std::uint64_t most_;
    std::uint64_t used_ = 0;
};

/// The work of a search for the edges nearest to a point or in a box: few edges are tested by brute
/// force, several at once; with more, about this many remain after pruning by boxes.
[[nodiscard]] constexpr std::uint64_t work_of_search(std::uint32_t edges) {
    constexpr std::uint32_t most = 24;
    return 8 + std::min(edges / 8, most);
}

}  // namespace nearfield::mtv
