#pragma once

#include <nearfield/shape.hpp>

#include <tools/benchmark/random.hpp>

#include <cstddef>
#include <cstdint>

/// \file
/// The outlines that the scenes of the table are made of. None touches or crosses itself; each lies
/// about the origin and reaches about 1 from it, unless it says otherwise.

namespace nearfield::benchmark {

/// A coast of n >= 8 vertices: a function of the seed, looked at more closely the larger n is.
/// Coasts of one seed share their bays; more vertices add smaller ones.
[[nodiscard]] Ring coast(std::uint64_t seed, std::size_t n);

/// A gear of 4 vertices a tooth.
[[nodiscard]] Ring gear(std::size_t teeth);

/// The distance, in x, at which the hooks of two links just hold each other.
inline constexpr double link_pitch = 3.62;

/// An S of n vertices, 4.2 long and 2.4 high: two hooks, one that is open above and one that is
/// open below.
[[nodiscard]] Ring link(std::size_t n);

/// A convex car body seen from above, n vertices, 2 x 1.
[[nodiscard]] Ring car(std::size_t n);

/// A bar from x = 0 to 4 with one side at the wave that both bars of the scene share, moved up by
/// `shift`: n vertices, two of them the corners at y = `back`, the other side.
[[nodiscard]] Ring wavy_bar(std::size_t n, double back, double shift);

/// A star of n vertices with radii between 0.6 and 1.
[[nodiscard]] Ring star(Random& random, std::size_t n);

/// Every edge as `factor` edges that wind about it by at most a twentieth of its length, and stay
/// within six degrees of it seen from its ends.
[[nodiscard]] Ring refined(Random& random, const Ring& ring, std::size_t factor);

}  // namespace nearfield::benchmark
