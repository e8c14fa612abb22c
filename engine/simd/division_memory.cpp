#include <engine/simd/division_memory.hpp>

#include <algorithm>

namespace nearfield::simd {
namespace {

template <class Entry>
Entry* with_room(std::deque<std::vector<Entry>>& lists, std::size_t depth, std::size_t count) {
    while (lists.size() <= depth) {
        lists.emplace_back();
    }
    std::vector<Entry>& list = lists[depth];
    if (list.size() < count + max_lanes) {
        list.resize(count + max_lanes);
    }
    return list.data();
}

}  // namespace

std::uint32_t* DivisionMemory::list(std::size_t depth, std::size_t count) {
    return with_room(lists_, depth, count);
}

double* DivisionMemory::numbers(std::size_t depth, std::size_t count) {
    return with_room(numbers_, depth, count);
}

Extent extent_of_points(const double* x, const double* y, const std::uint32_t* chosen,
                        std::uint32_t count) {
    Extent box{x[*chosen], y[*chosen], x[*chosen], y[*chosen]};
    for (std::uint32_t i = 1; i < count; ++i) {
        const double at_x = x[chosen[i]];
        const double at_y = y[chosen[i]];
        box = {std::min(box.low_x, at_x), std::min(box.low_y, at_y), std::max(box.high_x, at_x),
               std::max(box.high_y, at_y)};
    }
    return box;
}

std::uint32_t halve(const double* x, const double* y, const Extent& box, std::uint32_t* chosen,
                    std::uint32_t count) {
    const double* const along = box.high_x - box.low_x > box.high_y - box.low_y ? x : y;
    const std::uint32_t half = count / 2;
    std::nth_element(chosen, chosen + half, chosen + count,
                     [along](std::uint32_t i, std::uint32_t j) { return along[i] < along[j]; });
    return half;
}

}  // namespace nearfield::simd
