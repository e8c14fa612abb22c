#pragma once

#include <tools/io/scene.hpp>

#include <cstddef>

/// \file Scenes like the five in Table 2 of the paper, with the same numbers of objects and lines:
/// shapes and poses, no queries. `scale` multiplies the number of vertices and keeps the outlines
/// about the same.

namespace nearfield::benchmark {

/// 6 large non-convex objects close together, 719 lines.
[[nodiscard]] tools::Scene map_scene(std::size_t scale);
/// 13 meshing gears, one on a shaft with three sides, 391 lines.
[[nodiscard]] tools::Scene gears_scene(std::size_t scale);
/// 15 non-convex links that hold each other by their hooks, 440 lines: three chains side by side.
[[nodiscard]] tools::Scene links_scene(std::size_t scale);
/// 18 convex cars, 266 lines, some bumper to bumper.
[[nodiscard]] tools::Scene cars_scene(std::size_t scale);
/// 2 bars pressed into each other along a wave, 200 lines.
[[nodiscard]] tools::Scene wavy_scene(std::size_t scale);

}  // namespace nearfield::benchmark
