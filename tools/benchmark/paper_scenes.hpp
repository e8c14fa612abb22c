#pragma once

#include <tools/input/scene.hpp>

#include <cstddef>

/// \file
/// Scenes like the five of the paper's Table 2, with the same numbers of objects and lines: shapes
/// and where they are, no queries. `scale` multiplies the number of vertices and leaves the
/// outlines about where they are.

namespace nearfield::benchmark {

/// 6 large non-convex objects, 719 lines, close together.
[[nodiscard]] tools::Scene map_scene(std::size_t scale);
/// 13 gears in mesh, one on a shaft with three sides, 391 lines.
[[nodiscard]] tools::Scene gears_scene(std::size_t scale);
/// 15 non-convex links, 440 lines, that hold each other by their hooks: three chains side by side.
[[nodiscard]] tools::Scene links_scene(std::size_t scale);
/// 18 convex cars, 266 lines, some bumper to bumper.
[[nodiscard]] tools::Scene cars_scene(std::size_t scale);
/// 2 bars, 200 lines, pressed into each other along a wave.
[[nodiscard]] tools::Scene wavy_scene(std::size_t scale);

}  // namespace nearfield::benchmark
