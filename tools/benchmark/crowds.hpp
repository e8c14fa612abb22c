#pragma once

#include <tools/input/scene.hpp>

#include <cstddef>

/// \file
/// Many small objects; shapes and where they are, no queries.

namespace nearfield::benchmark {

/// 1,000 stars of 50 vertices side by side, about 2,400 pairs of which have boxes that meet.
[[nodiscard]] tools::Scene crowd_scene();

/// Pairs of stars of 50 vertices that overlap, no pair near another: objects 2 i and 2 i + 1.
[[nodiscard]] tools::Scene small_pairs_scene(std::size_t pairs);

}  // namespace nearfield::benchmark
