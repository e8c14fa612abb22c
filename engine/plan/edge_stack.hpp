#pragma once

#include <engine/geometry/float_arrays.hpp>
#include <engine/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>

/// \file Distances to the edges that can be near, with SIMD: compiled for several instruction
/// sets, of which the best that the machine supports is selected at run time. Single precision,
/// relative to a nearby origin.

namespace nearfield::plan {

/// A stack of lists of edges that may be near.
class EdgeStack : public geometry::FloatArrays<5> {
public:
    enum Number : std::uint8_t {
        start_x,
        start_y,
        along_x,  ///< from the start to the end
        along_y,
        inverse,  ///< of the squared length; 0 for an edge of no length
    };
};

/// Pushes the part of an edge that lies within `window` of the origin along both axes, so that the
/// rounding error of a distance in floats depends on the window and not on how far the edge
/// reaches. Along an axis where it lies wholly beyond the window, an edge is not cut. Returns the
/// squared length of the part, 0 for an edge of no length.
double push_part(const geometry::Vector& a, const geometry::Vector& b, double window,
                 std::uint32_t index, EdgeStack& edges);

/// Writes the squared distances of the edges first, ..., end - 1 from a point to `squared`, by
/// position on the stack; there is room for one more vector. Returns the smallest. The same bits on
/// every machine.
[[nodiscard]] float measure_squared(const EdgeStack& edges, std::size_t first, std::size_t end,
                                    float x, float y, float* squared);

/// Pushes those of the edges first, ..., end - 1 whose squared distance is at most `limit`, in the
/// same order.
void push_within(EdgeStack& edges, std::size_t first, std::size_t end, const float* squared,
                 float limit);

}  // namespace nearfield::plan
