#pragma once

#include <tools/dynamics/scene.hpp>

#include <cstddef>
#include <span>
#include <string>

/// \file
/// The paper's five simulations, with the numbers of objects and lines of its Table 2, and more of
/// their kind. Every one is the same each time it is made.

namespace nearfield::scenes {

/// 6 countries, 719 lines, drawn together and stirred.
[[nodiscard]] dynamics::Scene map_scene();
/// 13 gears on their shafts, 391 lines; the one in the middle is driven and drives the others.
[[nodiscard]] dynamics::Scene gears_scene();
/// A chain of 15 links, 440 lines, each with a ball in the socket of the next; its ends are held
/// and swayed.
[[nodiscard]] dynamics::Scene links_scene();
/// 18 cars, 266 lines, convex, in three lanes round a course, where they pass and bump each other.
[[nodiscard]] dynamics::Scene cars_scene();
/// 2 deformable bars, 200 lines, side by side and held at their backs; waves run up the right one
/// and are handed to the left one.
[[nodiscard]] dynamics::Scene wavy_scene();
/// The bars free, and far inside each other to begin with.
[[nodiscard]] dynamics::Scene overlap_scene();
/// Stars of 10 lines poured into a container, one batch of queries a frame.
[[nodiscard]] dynamics::Scene pour_scene(std::size_t bodies = 1000);

/// A scene by its name.
struct NamedScene {
    const char* name;
    dynamics::Scene (*make)();
};

/// All of them, the paper's first, in the order of its table.
[[nodiscard]] std::span<const NamedScene> all_scenes();
/// The first five.
[[nodiscard]] std::span<const NamedScene> paper_scenes();

}  // namespace nearfield::scenes
