#pragma once

#include <engine/plan/plan.hpp>
#include <engine/plan/tile_batch.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>

#include <cstdint>

/// Converts a tile's samples to the result of an intersection query.
namespace nearfield::records {

/// Returns the sample at the centre of a cell of a tile. `run`: edges of A, if A takes part with
/// its boundary.
[[nodiscard]] IntersectionSample make_sample(const plan::CheckedQuery& query,
                                             const plan::Tile& tile, std::uint32_t column,
                                             std::uint32_t row, plan::EdgeRun run);

/// Adds a tile's count and box to the result.
void add_summary(const plan::Tile& tile, const plan::TileSummary& summary,
                 IntersectionResult& result);

}  // namespace nearfield::records
