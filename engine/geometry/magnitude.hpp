#pragma once

#include <engine/geometry/placed_polygon.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::geometry {

[[nodiscard]] inline double largest_magnitude(const Box& box) {
    return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

/// The largest number that placing a shape in the world goes through; `box`: of the placed shape.
[[nodiscard]] inline double largest_magnitude(const PlacedPolygon& placed, const Pose& pose,
                                              const Box& box) {
    return std::max({largest_magnitude(box), placed.polygon().centre().cwiseAbs().maxCoeff(),
                     std::abs(pose.translation.x), std::abs(pose.translation.y)});
}
[[nodiscard]] inline double largest_magnitude(const PlacedPolygon& placed, const Pose& pose) {
    return largest_magnitude(placed, pose, placed.box());
}

}  // namespace nearfield::geometry
