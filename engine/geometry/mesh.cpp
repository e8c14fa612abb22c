#include <engine/geometry/mesh.hpp>

#include <numbers>

namespace nearfield::geometry {

double SubpixelGrid::largest_move() const {
    return 0.5 * std::numbers::sqrt2 / steps;
}

}  // namespace nearfield::geometry
