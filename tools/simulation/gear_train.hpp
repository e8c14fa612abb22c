#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::simulation {

/// Radians per second of the first gear of the train, once it has started.
inline constexpr double driver_spin = 0.8;

/// A gear that meshes with the gear that drives it.
struct TrainGear {
    std::size_t teeth = 0;
    std::size_t driver = 0;  ///< index of the previous gear in the train; for the first gear its
                             ///< own
    Vector2 place;
    double angle = 0.0;
};

/// A gear with 4 vertices per tooth about the origin, with a tooth at angle 0. Any two mesh if the
/// distance between their centres is the sum of their pitch radii.
[[nodiscard]] Ring gear_outline(std::size_t teeth);

/// 13 meshing gears with 97 teeth, drivers before the gears they drive: one in the middle, four
/// around it, and two around each of these.
[[nodiscard]] std::vector<TrainGear> gear_train();

}  // namespace nearfield::simulation
