#pragma once

#include <engine/geometry/float_arrays.hpp>

#include <cstddef>
#include <cstdint>

/// \file
/// What can be nearest in a box, sorted out with vectors: compiled for several instruction sets of
/// which the best that the machine has is chosen at run time. In single precision, relative to a
/// place nearby.

namespace nearfield::plan {

/// Edges that may be near, list upon list.
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

/// A box around its centre.
struct EdgeNode {
    float x = 0.0F;
    float y = 0.0F;
    float half_width = 0.0F;
    float half_height = 0.0F;
};

/// Pushes, of the edges first, ..., end - 1, those that can be nearest somewhere in a box, in the
/// same order. At least one edge. `slack`: what the distances of two edges may be off together.
///
/// The distance to an edge is a convex function: it lies above its tangent at the centre, and what
/// another one exceeds a linear function by is largest at a corner. So an edge whose tangent lies
/// above the distance to some other one at all four corners is nearest nowhere in the box. Held
/// against it are the edges nearest to the centre and to each corner.
void push_near(EdgeStack& edges, std::size_t first, std::size_t end, const EdgeNode& node,
               float slack);

}  // namespace nearfield::plan
