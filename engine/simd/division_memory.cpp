#include <engine/simd/division_memory.hpp>
#include <engine/simd/edge_kernels.hpp>

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

}  // namespace nearfield::simd
