#pragma once

#include <cstdint>
#include <vector>

/// \file
/// Shapes and where they are. Units are the caller's own, the same for every shape, pose and
/// tolerance; the frame is right-handed (x to the right, y up).

namespace nearfield {

/// A point, a displacement or a direction in the plane.
struct Vector2 {
    double x = 0.0;  ///< to the right
    double y = 0.0;  ///< up

    /// Both coordinates are equal.
    friend bool operator==(const Vector2&, const Vector2&) = default;
};

/// One closed line of straight edges. Edge i goes from vertex i to vertex i + 1, the last one back
/// to vertex 0. A last vertex equal to the first closes the ring twice and is dropped; other
/// repeated vertices are kept, so that indices stay the caller's. Orientation does not matter.
using Ring = std::vector<Vector2>;

/// A shape is a list of rings filled by the odd-even rule: outer boundaries, holes and separate
/// parts are all just rings, in any order. Rings may touch and cross.
///
/// A shape is refused (StatusCode::invalid_shape) when it has no ring, a ring has fewer than three
/// different vertices or lies on one line, a coordinate is not finite or its magnitude exceeds
/// `largest_coordinate`, all rings together are smaller than `smallest_extent`, or have more than
/// `most_vertices` vertices.
inline constexpr double largest_coordinate = 1e12;
/// The least that the longer side of a shape's bounding box may be. Nothing underflows then: what
/// is given in single precision (values of fields, what stays on the device) is a normal number
/// down to a millionth of the smallest tolerance that double precision resolves in such a shape,
/// and so are products of lengths in double precision.
inline constexpr double smallest_extent = 1e-20;
/// The most vertices that all rings of a shape together may have.
inline constexpr std::uint32_t most_vertices = 1U << 28U;

/// Names a shape of one context. The default value names none.
struct ShapeHandle {
    std::uint32_t index = UINT32_MAX;  ///< the context's own; UINT32_MAX: no shape
    std::uint32_t generation = 0;      ///< tells apart the shapes that had this index in turn

    /// Both name the same shape, in one context.
    friend bool operator==(const ShapeHandle&, const ShapeHandle&) = default;
};

/// A rigid transform from shape coordinates to world coordinates: rotate counter-clockwise about
/// the origin of the shape's own coordinates, then translate.
struct Pose {
    Vector2 translation = {};  ///< world units, applied after the rotation
    double angle = 0.0;        ///< radians, counter-clockwise
};

/// A shape at a place.
struct Instance {
    ShapeHandle shape = {};  ///< of the context that answers
    Pose pose = {};          ///< from the shape's coordinates to the world
};

/// Two of a list of instances, by their positions in it.
struct InstancePair {
    std::uint32_t first = 0;   ///< position in the list
    std::uint32_t second = 0;  ///< > first

    /// The same two, in the same order.
    friend bool operator==(const InstancePair&, const InstancePair&) = default;
};

/// An axis-aligned rectangle in world coordinates.
struct Rectangle {
    Vector2 min = {};  ///< low corner
    Vector2 max = {};  ///< high corner
};

}  // namespace nearfield
