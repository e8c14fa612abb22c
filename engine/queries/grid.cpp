#include <engine/queries/grid.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::queries {
namespace {

std::uint64_t cells_along(double length, double cell) {
    // A length that is a whole number of cells up to rounding yields that number.
    const double count = std::ceil(length / cell - 1e-9);
    return static_cast<std::uint64_t>(std::clamp(count, 1.0, 1e18));
}

}  // namespace

Grid Grid::covering(const geometry::Box& box, double cell) {
    const geometry::Vector size = box.sizes();
    return {box.min(), cell, cells_along(size.x(), cell), cells_along(size.y(), cell)};
}

Region region_of(const Grid& grid) {
    const geometry::Vector max =
        grid.origin + grid.cell * geometry::Vector(static_cast<double>(grid.width),
                                                   static_cast<double>(grid.height));
    constexpr std::uint64_t most = UINT32_MAX;
    return {geometry::to_public(grid.origin), geometry::to_public(max),
            static_cast<std::uint32_t>(std::min(grid.width, most)),
            static_cast<std::uint32_t>(std::min(grid.height, most))};
}

}  // namespace nearfield::queries
