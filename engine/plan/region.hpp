#pragma once

#include <engine/plan/grid.hpp>
#include <nearfield/result.hpp>

#include <algorithm>
#include <cstdint>

namespace nearfield::plan {

/// A grid as results report it.
[[nodiscard]] inline Region region_of(const Grid& grid) {
    const geometry::Vector max =
        grid.origin + grid.cell * geometry::Vector(static_cast<double>(grid.width),
                                                   static_cast<double>(grid.height));
    constexpr std::uint64_t most = UINT32_MAX;
    return {geometry::to_public(grid.origin), geometry::to_public(max),
            static_cast<std::uint32_t>(std::min(grid.width, most)),
            static_cast<std::uint32_t>(std::min(grid.height, most))};
}

}  // namespace nearfield::plan
