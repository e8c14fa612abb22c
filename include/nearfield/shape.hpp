#pragma once

#include <nearfield/export.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// \file
/// Shapes and poses. Units are the caller's own, the same for every shape, pose and tolerance. The
/// frame is right-handed: x to the right, y up.
///
/// A shape is a list of rings, filled by the odd-even rule: outer boundaries, holes and separate
/// parts are all rings, in any order. Rings may touch and cross. Context::add_shape states which
/// shapes are invalid.

namespace nearfield {

/// A point, a displacement or a direction in the plane.
struct Vector2 {
    double x = 0.0;  ///< to the right
    double y = 0.0;  ///< up

    /// True if both coordinates are equal.
    friend bool operator==(const Vector2&, const Vector2&) = default;
};

/// A closed polygonal line. Edge i goes from vertex i to vertex i + 1, and the last edge returns to
/// vertex 0. A last vertex equal to the first is redundant and dropped. Other repeated vertices are
/// kept, so indices stay the caller's. Orientation does not matter.
using Ring = std::vector<Vector2>;

/// A ring in the caller's own numbers, which are read where they lie: vertex i is the pair
/// numbers[i * stride], numbers[i * stride + 1]. Other numbers between the pairs are ignored, so
/// the vertices may be those of a mesh. Otherwise the ring is as Ring; numbers in single precision
/// are exact in double precision. Borrowed, as a span is.
///
/// A stride below 2, or numbers that end within a pair, are invalid_shape where the ring is used.
class RingView {
public:
    /// In double precision. `stride`: from one vertex to the next, in numbers, not in bytes.
    explicit RingView(std::span<const double> numbers, std::size_t stride = 2) noexcept
        : doubles_(numbers.data()), count_(numbers.size()), stride_(stride) {}
    /// In single precision. `stride`: from one vertex to the next, in numbers, not in bytes.
    explicit RingView(std::span<const float> numbers, std::size_t stride = 2) noexcept
        : floats_(numbers.data()), count_(numbers.size()), stride_(stride) {}

    /// The numbers, from the first one to the last; null if they are in single precision.
    [[nodiscard]] const double* doubles() const noexcept { return doubles_; }
    /// The numbers in single precision, from the first one to the last; null if they are in double
    /// precision.
    [[nodiscard]] const float* floats() const noexcept { return floats_; }
    /// The count of numbers.
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    /// From one vertex to the next, in numbers.
    [[nodiscard]] std::size_t stride() const noexcept { return stride_; }

private:
    const double* doubles_ = nullptr;
    const float* floats_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = 2;
};

/// Maximum magnitude of a coordinate of a shape, pose, rectangle or point, and of a tolerance or
/// distance.
inline constexpr double largest_coordinate = 1e12;
/// Minimum length of the longer side of a shape's bounding box. It rules out underflow: results in
/// single precision (values of fields, outputs on the device) are normal numbers down to a
/// millionth of the smallest tolerance that double precision resolves in such a shape, and so are
/// products of lengths in double precision.
inline constexpr double smallest_extent = 1e-20;
/// Maximum number of vertices of all rings of a shape together.
inline constexpr std::uint32_t max_vertices = 1U << 28U;

/// Names a shape of one context. The default value names none. A handle of another context, or of a
/// shape that was removed, is refused (unknown_shape).
struct ShapeHandle {
    std::uint32_t index = UINT32_MAX;  ///< assigned by the context; UINT32_MAX: no shape
    std::uint32_t generation = 0;      ///< distinguishes successive shapes with the same index
    std::uint32_t context = 0;         ///< number of the context, unique in the process

    /// True if both name the same shape of one context.
    friend bool operator==(const ShapeHandle&, const ShapeHandle&) = default;
};

/// A rigid transform from shape coordinates to world coordinates: rotate counter-clockwise about
/// the origin of the shape's own coordinates, then translate.
struct Pose {
    Vector2 translation = {};  ///< world units, applied after the rotation
    double angle = 0.0;        ///< radians, counter-clockwise

    /// True if translation and angle are equal.
    friend bool operator==(const Pose&, const Pose&) = default;
};

/// A shape with a pose.
struct Instance {
    ShapeHandle shape = {};  ///< of the context that answers the query
    Pose pose = {};          ///< from shape coordinates to world coordinates
};

/// Two instances of a list, by position.
struct InstancePair {
    std::uint32_t first = 0;   ///< position in the list
    std::uint32_t second = 0;  ///< position in the list, > first

    /// True if both positions are equal.
    friend bool operator==(const InstancePair&, const InstancePair&) = default;
};

/// An axis-aligned rectangle in world coordinates.
struct Rectangle {
    Vector2 min = {};  ///< low corner
    Vector2 max = {};  ///< high corner
};

}  // namespace nearfield
