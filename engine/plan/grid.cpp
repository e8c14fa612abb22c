#include <engine/plan/grid.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::plan {
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

}  // namespace nearfield::plan
