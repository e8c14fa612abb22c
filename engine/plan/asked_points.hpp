#pragma once

#include <engine/plan/plan.hpp>

#include <cstddef>

namespace nearfield::plan {

/// The largest distance from B at which points outside B matter; infinity where no distance is too
/// large.
[[nodiscard]] double reach_of(const PlannedQuery& query);

/// Whether the CPU decides the points of a tile, since so many edges may matter to each of them
/// that the device would take too long. `edges`: in the tile's lists.
[[nodiscard]] bool is_left_to_cpu(const PlannedQuery& query, std::size_t edges);

}  // namespace nearfield::plan
