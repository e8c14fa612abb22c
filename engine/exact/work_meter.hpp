#pragma once

#include <algorithm>
#include <cstdint>

namespace nearfield::exact {

/// Counts work, in edges held against an edge, a point or a line, and says when there has been
/// enough.
class WorkMeter {
public:
    explicit WorkMeter(std::uint64_t most = 0) : most_(most) {}

    void add(std::uint64_t work) { used_ += work; }
    [[nodiscard]] std::uint64_t used() const { return used_; }
    [[nodiscard]] std::uint64_t left() const { return most_ - std::min(most_, used_); }
    [[nodiscard]] bool is_used_up() const { return used_ >= most_; }

private:
    std::uint64_t most_;
    std::uint64_t used_ = 0;
};

/// What a search for the edge nearest to a point counts as: few are held against it one by one,
/// several at once; of more, boxes leave about so many.
[[nodiscard]] constexpr std::uint64_t work_of_search(std::uint32_t edges) {
    constexpr std::uint32_t most = 64;
    return 16 + std::min(edges / 4, most);
}

}  // namespace nearfield::exact
