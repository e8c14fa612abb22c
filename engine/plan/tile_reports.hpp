#pragma once

#include <engine/plan/plan.hpp>
#include <nearfield/tile.hpp>

#include <vector>

namespace nearfield::plan {

/// Appends a report on each tile of a plan to `reports`.
void report_tiles(const Plan& plan, std::vector<TileReport>& reports);

}  // namespace nearfield::plan
