#pragma once

#include <nearfield/shape.hpp>

#include <tools/benchmark/random.hpp>

#include <cstddef>
#include <cstdint>

/// \file Outlines for the scenes of the table. None touches or crosses itself. Unless noted, each
/// is centred on the origin with a radius of about 1.

namespace nearfield::benchmark {

/// A coast of n >= 8 vertices, determined by the seed. Coasts with the same seed share their large
/// bays; more vertices add smaller ones.
[[nodiscard]] Ring coast(std::uint64_t seed, std::size_t n);

/// A gear with 4 vertices per tooth.
[[nodiscard]] Ring gear(std::size_t teeth);

/// The distance in x at which the hooks of two links just hold each other.
inline constexpr double link_pitch = 3.62;

/// An S of n vertices, 4.2 long and 2.4 high: two hooks, one open at the top and one open at the
/// bottom.
[[nodiscard]] Ring link(std::size_t n);

/// A convex car body seen from above: n vertices, 2 x 1.
[[nodiscard]] Ring car(std::size_t n);

/// A bar from x = 0 to 4 with n vertices. One side follows the wave that both bars of the scene
/// share, moved up by `shift`; the other is straight, its two corners at y = `back`.
[[nodiscard]] Ring wavy_bar(std::size_t n, double back, double shift);

/// A star of n vertices with radii between 0.6 and 1.
[[nodiscard]] Ring star(Random& random, std::size_t n);

/// Replaces every edge by `factor` edges that deviate from it by at most a twentieth of its length,
/// and by at most six degrees seen from its ends.
[[nodiscard]] Ring refined(Random& random, const Ring& ring, std::size_t factor);

}  // namespace nearfield::benchmark
