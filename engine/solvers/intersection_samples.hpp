#pragma once

#include <engine/queries/checked_query.hpp>
#include <engine/queries/tile_edges.hpp>
#include <nearfield/result.hpp>

#include <shaders/layout.h>

#include <cstdint>

/// Converts a tile's samples to the result of an intersection query.
namespace nearfield::solvers {

/// Returns the sample at the centre of a cell of a tile. `run`: edges of A, if A takes part with
/// its boundary.
[[nodiscard]] IntersectionSample make_sample(const queries::CheckedQuery& query,
                                             const queries::Tile& tile, std::uint32_t column,
                                             std::uint32_t row, queries::EdgeRun run);

/// Adds a tile's count and box to the result.
void add_summary(const queries::Tile& tile, const shaders::TileSummary& summary,
                 IntersectionResult& result);

}  // namespace nearfield::solvers
