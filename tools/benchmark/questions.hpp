#pragma once

#include <tools/io/scene.hpp>

#include <cstddef>

/// \file The queries that the rows of the table run on the scenes, at tolerance d.

namespace nearfield::benchmark {

/// The pairs that are queried.
enum class Pairs {
    all,        ///< every pair whose boxes overlap (or are within reach), found anew each frame
    neighbors,  ///< each pair of objects 2 i and 2 i + 1 once
};

/// The minimum a host needs: which vertices are inside and the greatest depth; no records.
[[nodiscard]] tools::QueryRequest vertex_penetration(double tolerance);
/// Samples along the boundary, at most a cell apart, with depth and direction each.
[[nodiscard]] tools::QueryRequest boundary_penetration(double tolerance);
/// Contact points within 2 d.
[[nodiscard]] tools::QueryRequest contacts(double tolerance);
[[nodiscard]] tools::QueryRequest separation(double tolerance);
/// Whether shapes share a point; exact at any tolerance.
[[nodiscard]] tools::QueryRequest intersection_test(double tolerance);
/// Volume against volume: the number of samples and the area; no list of samples.
[[nodiscard]] tools::QueryRequest intersection(double tolerance);
/// Distances at `cells` x `cells` cell centres of a square centred on `middle`.
[[nodiscard]] tools::QueryRequest square_field(Vector2 middle, double side, std::size_t cells);

/// The scene with this query added for these pairs of its objects.
[[nodiscard]] tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request,
                                 Pairs pairs);

/// The scene with this query added for two of its objects.
[[nodiscard]] tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request,
                                 std::size_t a, std::size_t b);

}  // namespace nearfield::benchmark
