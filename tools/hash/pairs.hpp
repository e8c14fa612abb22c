#pragma once

#include <nearfield/shape.hpp>

#include <tools/hash/integers.hpp>

#include <vector>

namespace nearfield::hash {

/// Two shapes, and how large their details are.
struct Pair {
    std::vector<Ring> a;
    std::vector<Ring> b;
    Pose pose_a;
    Pose pose_b;
    double tolerance = 0.0;
};

/// A random shape of up to about 40 vertices, within 1 or so of the origin: a star, a spiky star,
/// one with a hole, a ring that crosses itself, or a polygon on a lattice.
[[nodiscard]] std::vector<Ring> any_shape(Integers& integers);

/// A random pair that overlaps, touches or is close. Half of the pairs are degenerate: a shape with
/// itself, also moved by its own coordinates or by almost nothing, and shapes on one lattice. Some
/// are far from the origin.
[[nodiscard]] Pair any_pair(Integers& integers);

}  // namespace nearfield::hash
