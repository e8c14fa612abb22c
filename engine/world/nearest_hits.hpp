#pragma once

#include <engine/geometry/segment.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/solvers/nearest_feature.hpp>
#include <nearfield/world.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace nearfield::world {

/// The nearest point of an edge of an instance, whoever has found it.
struct NearestOnInstance {
    InstanceHandle instance;
    double distance = 0.0;  ///< NearestHit::distance
    std::uint32_t edge = 0;
    geometry::NearestOnSegment on_edge;
};

/// `rounding`: of the vertices of the instance.
inline NearestHit hit_of(const NearestOnInstance& found, const geometry::TransformedPolygon& placed,
                         double rounding) {
    return {found.instance, found.distance,
            rounding + placed.polygon().deviation() +
                8.0 * std::numeric_limits<double>::epsilon() * std::abs(found.distance),
            geometry::to_public(found.on_edge.point),
            solvers::feature_at(placed, found.edge, found.on_edge.parameter)};
}

}  // namespace nearfield::world
