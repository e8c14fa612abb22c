#pragma once

#include <nearfield/shape.hpp>

#include <tools/simulation/scene.hpp>

#include <cstddef>
#include <span>
#include <string>
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

/// The outlines of six countries, about the origin, each of the same area.
[[nodiscard]] std::vector<Ring> countries(double area);

// The paper's five simulations, with the numbers of objects and lines in its Table 2, and
// similar ones. Each is identical every time it is made.

/// 6 countries, 719 lines, that are drawn together and stirred.
[[nodiscard]] Scene map_scene();
/// 13 gears on their shafts, 391 lines; the one in the middle is driven and drives the others.
[[nodiscard]] Scene gears_scene();
/// A chain of 15 links, 440 lines, each with a ball in the socket of the next; its ends are held
/// and swayed.
[[nodiscard]] Scene links_scene();
/// 18 convex cars, 266 lines, in three lanes around a course, where they pass and bump each other.
[[nodiscard]] Scene cars_scene();
/// 2 deformable bars, 200 lines, side by side and held at their backs; waves travel up the right
/// one and pass to the left one.
[[nodiscard]] Scene wavy_scene();
/// The same bars, free and initially far inside each other.
[[nodiscard]] Scene overlap_scene();
/// Stars of 10 lines poured into a container, one batch of queries per frame.
[[nodiscard]] Scene pour_scene(std::size_t bodies = 1000);

/// A scene with its name.
struct NamedScene {
    const char* name;
    Scene (*make)();
};

/// All scenes: first the paper's, in the order of its table.
[[nodiscard]] std::span<const NamedScene> all_scenes();
/// The first five.
[[nodiscard]] std::span<const NamedScene> paper_scenes();

}  // namespace nearfield::simulation
