#pragma once

#include <engine/world/motions.hpp>
#include <engine/world/pair_list.hpp>
#include <nearfield/world_pairs.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace nearfield {

/// What a table keeps from update to update, besides its rows.
struct PairTableBase::State {
    std::weak_ptr<const void> world;  // identity of the one of the last update
    world::Motions motions;           // for times of impact
    world::PairList list;
    std::vector<std::uint32_t> row_of;  // by candidate; PairList::none: no hit
    std::vector<std::uint32_t> row_of_before;
    std::uint32_t answered = 0;
};

}  // namespace nearfield
