#pragma once

#include <engine/mtv/work_budget.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::mtv {

/// The depth of a point inside edges by the even-odd rule: the distance to the nearest edge,
/// negative outside.
[[nodiscard]] double depth_in(const simd::TransformedEdges& edges, const geometry::Vector& point);

/// A certificate for how deep a shape lies in another one.
///
/// A disc inside the shape: its radius plus the depth of its centre in the other shape is a lower
/// bound on the length of any separating translation. A vertex is a disc of radius 0. A group of
/// vertices around a centre: the depth of each differs from the centre's by at most its distance
/// from the centre.
struct OverlapCertificate {
    geometry::Vector centre;
    double radius = 0.0;      ///< of the disc
    double spread = 0.0;      ///< largest distance of a vertex of the group from the centre
    std::uint32_t first = 0;  ///< of a group: its first part, in the array of all certificates
    std::uint32_t parts = 0;  ///< number of consecutive parts
    bool is_vertex = false;
};

/// Appends discs that touch the middle of some edges and are as large as fit inside, all vertices,
/// and groups of eight consecutive vertices, of eight such groups, and so on. Lists in `top` the
/// discs, largest first, and the groups that contain all vertices.
void add_certificates(const simd::TransformedEdges& edges, WorkBudget& work,
                      std::vector<OverlapCertificate>& certificates,
                      std::vector<std::uint32_t>& top);

}  // namespace nearfield::mtv
