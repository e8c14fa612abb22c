#pragma once

#include <engine/geometry/float_arrays.hpp>
#include <engine/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>

/// \file
/// Distances of a point from edges that may be near, compiled for several instruction sets; the
/// best one that the machine supports is selected at run time. In single precision, relative to a
/// nearby origin, with the same bits on every machine.

namespace nearfield::geometry {

/// Edges that may be near, in cells of a grid.
class EdgeList : public FloatArrays<6> {
public:
    enum Number : std::uint8_t {
        start_x,
        start_y,
        along_x,  ///< from the start to the end
        along_y,
        inverse_x,  ///< the same divided by its squared length; 0 for zero length
        inverse_y,
    };
};

/// Returns the squared length of the edge, 0 for one that is too short to have a direction.
double push_edge(const Vector& start, const Vector& end, std::uint32_t index, EdgeList& edges);

/// Writes the squared distances of the edges first, ..., end - 1 from a point to `squared`, by
/// position in the list; there is room for one more vector. Returns the smallest; infinity if there
/// are none.
[[nodiscard]] float measure_squared(const EdgeList& edges, std::size_t first, std::size_t end,
                                    float x, float y, float* squared);

/// Appends to a list, which may be the same, those of the edges first, ..., end - 1 whose squared
/// distance is at most `limit`, in the same order.
void push_within(const EdgeList& from, std::size_t first, std::size_t end, const float* squared,
                 float limit, EdgeList& to);

}  // namespace nearfield::geometry
