#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/queries/boundary_points.hpp>

#include <cstdint>

namespace nearfield::solvers {

/// A normal at a sample of a boundary that has been asked for: that of an edge, or of the two edges
/// at a vertex.
struct AskedBoundaryNormal {
    narrowphase::AskedNormal before;  ///< of the edge that ends at a vertex
    narrowphase::AskedNormal after;   ///< of the sample's edge
    bool at_vertex = false;
};

/// Asks for the unit normal that points out of a polygon at a place on one of its edges; for a
/// zero-length edge, that of the next edge that has a length.
[[nodiscard]] AskedBoundaryNormal ask_outward_normal(narrowphase::Boundary& boundary,
                                                     std::uint32_t edge, double parameter);

/// The same at a sample of the boundary. At a vertex: between the normals of its two edges, or one
/// of them if they cancel.
[[nodiscard]] AskedBoundaryNormal ask_outward_normal_at(narrowphase::Boundary& boundary,
                                                        const queries::BoundaryPoint& point);

/// Precondition: boundary.answer_asked() has been called since.
[[nodiscard]] geometry::Vector outward_normal(const narrowphase::Boundary& boundary,
                                              const AskedBoundaryNormal& asked);

}  // namespace nearfield::solvers
