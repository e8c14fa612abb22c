#pragma once

#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/round.hpp>
#include <nearfield/result.hpp>

#include <cstdint>

/// From what was found in a tile to what the result of an intersection says.
namespace nearfield {

/// The sample at the centre of a cell of a tile. `run`: of A's edges, where A takes part by its
/// boundary.
[[nodiscard]] IntersectionSample make_sample(const plan::PlannedQuery& planned,
                                             const plan::Tile& tile, std::uint32_t column,
                                             std::uint32_t row, plan::EdgeRun run);

/// Adds a tile's count and box to the result's.
void add_summary(const plan::Tile& tile, const plan::TileSummary& summary,
                 IntersectionResult& result);

}  // namespace nearfield
