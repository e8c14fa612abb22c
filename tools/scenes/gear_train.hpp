#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::scenes {

/// Radians a second of the first gear of the train, once it has started.
inline constexpr double driver_spin = 0.8;

/// A gear in mesh with the one that drives it.
struct TrainGear {
    std::size_t teeth = 0;
    std::size_t driver = 0;  ///< the gear before it in the train; of the first: itself
    Vector2 place;
    double angle = 0.0;
};

/// A gear of 4 vertices a tooth about the origin, a tooth at angle 0. All of these mesh with each
/// other where their centres are as far apart as their pitch radii together.
[[nodiscard]] Ring gear_outline(std::size_t teeth);

/// 13 gears in mesh, 97 teeth, the drivers before those they drive: one in the middle, four about
/// it, and two about each of these.
[[nodiscard]] std::vector<TrainGear> gear_train();

}  // namespace nearfield::scenes
