#pragma once

#include <tools/input/scene.hpp>

#include <cstddef>

/// \file
/// What the rows of the table ask of the scenes, at a tolerance d.

namespace nearfield::benchmark {

/// Between whom.
enum class Pairs {
    all,        ///< every pair whose boxes meet (or are within reach), found anew each frame
    neighbors,  ///< objects 2 i and 2 i + 1, once
};

/// The least a host asks for: which vertices are inside, how deep the deepest is; no records.
[[nodiscard]] tools::QueryRequest vertex_penetration(double tolerance);
/// Samples along the boundary, at most a cell apart, each with depth and direction.
[[nodiscard]] tools::QueryRequest boundary_penetration(double tolerance);
/// Contact points within 2 d.
[[nodiscard]] tools::QueryRequest contacts(double tolerance);
[[nodiscard]] tools::QueryRequest separation(double tolerance);
/// Whether shapes have a point in common; exact, whatever the tolerance.
[[nodiscard]] tools::QueryRequest intersection_test(double tolerance);
/// Volume against volume: how many samples, which area; no list of samples.
[[nodiscard]] tools::QueryRequest intersection(double tolerance);
/// Distances at `cells` x `cells` cell centres of a square about `middle`.
[[nodiscard]] tools::QueryRequest square_field(Vector2 middle, double side, std::size_t cells);

/// The scene with this question asked between these of its objects.
[[nodiscard]] tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request,
                                 Pairs pairs);

/// The scene with this question asked between two of its objects.
[[nodiscard]] tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request,
                                 std::size_t a, std::size_t b);

}  // namespace nearfield::benchmark
