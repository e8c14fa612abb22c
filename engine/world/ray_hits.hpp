#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/world.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

/// \file What segments and the edges that they hit have in common, whoever finds them.

namespace nearfield::world {

/// Bound on the rounding of positions along a segment.
inline double rounding_along(const geometry::Vector& from, const geometry::Vector& to) {
    return 4.0 * std::numeric_limits<double>::epsilon() *
           (from.lpNorm<Eigen::Infinity>() + to.lpNorm<Eigen::Infinity>());
}

/// True if an edge from `start` to `end` joins two vertices of its polygon at the same place. It
/// has no normal, and the edges beside it are hit wherever it would be.
inline bool is_repeated_vertex(const geometry::Vector& start, const geometry::Vector& end,
                               const geometry::Polygon& polygon, std::uint32_t edge) {
    // Far from the origin others, too, may have no length left; those are rare.
    return start == end && polygon.vertices()[edge] == polygon.vertices()[polygon.next(edge)];
}

/// An edge that is hit. Positions in the world.
struct EdgeHit {
    geometry::Vector start;
    geometry::Vector end;
    double rounding = 0.0;   ///< of the edge's vertices and of positions along the segment
    double deviation = 0.0;  ///< of the instance's shape
    InstanceHandle instance;
    std::uint32_t edge = 0;
    double parameter = 0.0;
};

/// A unit vector. Squares of lengths that are neither tiny nor huge can be used.
inline geometry::Vector normalized(const geometry::Vector& v) {
    constexpr double low = 1e-200;
    constexpr double high = 1e200;
    const double squared = v.squaredNorm();
    return squared > low && squared < high ? geometry::Vector(v / std::sqrt(squared))
                                           : v.stableNormalized();
}

/// Writes every member of a hit: to write them in place is quicker than to copy it.
inline void write_hit(const geometry::Vector& from, const geometry::Vector& to, const EdgeHit& edge,
                      RayHit& hit) {
    const geometry::Vector way = to - from;
    const geometry::Vector along = edge.end - edge.start;
    // Far from the origin an edge may be shorter than what rounding leaves of it.
    const bool has_length = along != geometry::Vector::Zero();
    geometry::Vector normal =
        normalized(has_length ? geometry::Vector(-along.y(), along.x()) : geometry::Vector(-way));
    // Against the way, without a branch, which nobody could predict.
    normal *= std::copysign(1.0, 0.0 - normal.dot(way));
    hit.instance = edge.instance;
    hit.parameter = edge.parameter;
    // What is as close as rounding allows is hit; the edge and the point are rounded once more.
    hit.error_bound = 2.0 * edge.rounding + edge.deviation;
    hit.point = geometry::to_public(from + edge.parameter * way);
    hit.normal = geometry::to_public(normal);
    hit.edge = edge.edge;
}

}  // namespace nearfield::world
