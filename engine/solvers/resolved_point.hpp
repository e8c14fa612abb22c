#pragma once

#include <engine/geometry/vector.hpp>
#include <nearfield/result.hpp>

#include <cstdint>

namespace nearfield::solvers {

/// A point of A relative to the boundary of B, in double precision.
struct ResolvedPoint {
    geometry::Vector point;
    geometry::Vector nearest;  ///< the point of B's boundary nearest to it
    double distance = 0.0;
    std::uint32_t edge = 0;  ///< of B: an edge that contains `nearest`
    double parameter = 0.0;  ///< position on the edge: 0 at its first vertex, 1 at its last
    Feature feature;         ///< of B: the feature that contains `nearest`
    bool inside = false;     ///< inside B, and not just touching its boundary
    bool unique = true;
};

}  // namespace nearfield::solvers
