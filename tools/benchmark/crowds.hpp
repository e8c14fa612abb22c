#pragma once

#include <tools/io/scene.hpp>

#include <cstddef>

/// \file Scenes of many small objects: shapes and poses, no queries.

namespace nearfield::benchmark {

/// Stars of 50 vertices side by side; the boxes of about 2.4 times as many pairs overlap.
[[nodiscard]] tools::Scene crowd_scene(std::size_t objects = 1000);

/// Overlapping pairs of 50-vertex stars, objects 2 i and 2 i + 1; no pair is near another.
[[nodiscard]] tools::Scene small_pairs_scene(std::size_t pairs);

}  // namespace nearfield::benchmark
