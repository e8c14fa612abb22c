#include <engine/geometry/mesh.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::geometry {

double SubpixelGrid::snap(double coordinate) const {
    return std::floor(coordinate * steps + 0.5) / steps;
}

double SubpixelGrid::largest_move() const {
    return 0.5 * std::numbers::sqrt2 / steps;
}

}  // namespace nearfield::geometry
