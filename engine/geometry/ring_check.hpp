#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <span>
#include <string>

namespace nearfield::geometry {

/// Throws StatusException with invalid_shape.
[[noreturn]] void refuse_shape(const std::string& message);

/// Why a coordinate cannot be used; empty if it can: it is finite and at most `largest_coordinate`.
[[nodiscard]] std::string coordinate_error(double value);

/// True if both coordinates can be used.
[[nodiscard]] bool usable(const Vector2& vertex);

/// "ring 3, vertex 0: x is not a number"; precondition: the vertex is not usable.
[[nodiscard]] std::string vertex_error(std::size_t ring, std::size_t vertex, const Vector2& point);

/// Throws StatusException with invalid_shape that names the first vertex that is not usable.
void require_usable(std::span<const Ring> rings);

/// The vertices of a ring without a closing vertex that repeats the first.
[[nodiscard]] std::span<const Vector2> open_ring(const Ring& ring);
[[nodiscard]] bool has_three_different(std::span<const Vector2> vertices);

/// The largest magnitude of a coordinate.
[[nodiscard]] double largest_of(const Vector2& vertex);
[[nodiscard]] double largest_coordinate_of(std::span<const Ring> rings);

/// The least width of a ring that is told from none: 2^-47 of its largest coordinate. A shape
/// accepts every ring whose strip_width() is larger: it refuses rings whose vertices are within
/// 2^-49 of the largest coordinate of the line that the first of the two strips lies along.
[[nodiscard]] double smallest_width(double largest_magnitude);

/// The width of a strip that holds all vertices of a ring, up to rounding: along the line from the
/// first vertex to the one farthest from it, or from there to the farthest vertex, whichever is
/// narrower. At most a few times the least width of any strip.
[[nodiscard]] double strip_width(std::span<const Vector2> vertices);

}  // namespace nearfield::geometry
