#pragma once

#include <engine/geometry/transformed_polygon.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::geometry {

[[nodiscard]] inline double largest_magnitude(const Box& box) {
    return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

/// The largest magnitude that occurs while a shape is transformed to the world. `box`: the
/// transformed shape's.
[[nodiscard]] inline double largest_magnitude(const TransformedPolygon& placed, const Pose& pose,
                                              const Box& box) {
    return std::max({largest_magnitude(box), placed.polygon().centre().cwiseAbs().maxCoeff(),
                     std::abs(pose.translation.x), std::abs(pose.translation.y)});
}
[[nodiscard]] inline double largest_magnitude(const TransformedPolygon& placed, const Pose& pose) {
    return largest_magnitude(placed, pose, placed.box());
}

}  // namespace nearfield::geometry
