#pragma once

#include <engine/simd/aabb_tree.hpp>
#include <engine/simd/division_memory.hpp>

#include <cstdint>

namespace nearfield::simd::kernels {

/// The start and direction of an axis-parallel ray.
struct Ray {
    double x = 0.0;
    double y = 0.0;
    bool upwards = false;  ///< otherwise to the right
};

/// The line of the edge that a ray starts on.
struct LineOfEdge {
    double along_x = 0.0;
    double along_y = 0.0;
    double rounding = 0.0;  ///< rounding error of the vertices and of the ray's start
};

/// Many rays in one direction, as a structure of arrays.
struct Rays {
    std::uint32_t count = 0;
    const double* x = nullptr;  ///< of the starts
    const double* y = nullptr;
    const double* along_x = nullptr;  ///< of the edges they start on; null if they start on none
    const double* along_y = nullptr;
    double rounding = 0.0;
    bool upwards = false;
};

/// True if a ray crosses an odd number of edges.
[[nodiscard]] bool crossings_are_odd(const AabbTree& tree, const Ray& ray, VisitsLeft& left);

/// The same, without the edges that run along a line through the ray's start: the edge it starts
/// on, and any others that contain the start. Precondition: the ray leaves the line at an angle of
/// 45 degrees or more.
[[nodiscard]] bool crossings_of_others_are_odd(const AabbTree& tree, const Ray& ray,
                                               const LineOfEdge& line, VisitsLeft& left);

/// The same for many rays at once: writes 1 to `odd` for each that crosses an odd number of edges,
/// else 0. Rays and edges are divided together, so boxes of edges that overlap do not slow it down.
void find_odd_crossings(const EdgeArrays& edges, const Rays& rays, DivisionMemory& memory,
                        std::uint8_t* odd);

}  // namespace nearfield::simd::kernels
