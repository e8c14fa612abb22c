#include <engine/plan/plan.hpp>

#include <algorithm>

namespace nearfield::plan {

std::uint32_t Tile::block_side() const {
    const std::uint32_t longest = std::max(width, height);
    return std::max(smallest_block, (longest + blocks_along - 1) / blocks_along);
}

void Plan::clear() {
    queries.clear();
    tiles.clear();
    points.clear();
    extent = {};
    rounds = 0;
    result_bytes = 0.0;
}

}  // namespace nearfield::plan
