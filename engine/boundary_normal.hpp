#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/plan/boundary_points.hpp>

#include <cstdint>

namespace nearfield {

/// The unit normal that points out of a polygon at a place on one of its edges; of an edge of no
/// length that of the next one that has one.
[[nodiscard]] geometry::Vector outward_normal(exact::Boundary& boundary, std::uint32_t edge,
                                              double parameter);

/// The same at a sample of the boundary: at a vertex between the normals of its two edges; where
/// these cancel, one of them.
[[nodiscard]] geometry::Vector outward_normal_at(exact::Boundary& boundary,
                                                 const plan::BoundaryPoint& point);

}  // namespace nearfield
