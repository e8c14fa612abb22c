#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/plan/boundary_points.hpp>

#include <cstdint>

namespace nearfield::records {

/// Returns the unit normal that points out of a polygon at a place on one of its edges; for a
/// zero-length edge, that of the next edge that has a length.
[[nodiscard]] geometry::Vector outward_normal(narrowphase::Boundary& boundary, std::uint32_t edge,
                                              double parameter);

/// The same at a sample of the boundary. At a vertex: between the normals of its two edges, or one
/// of them if they cancel.
[[nodiscard]] geometry::Vector outward_normal_at(narrowphase::Boundary& boundary,
                                                 const plan::BoundaryPoint& point);

}  // namespace nearfield::records
