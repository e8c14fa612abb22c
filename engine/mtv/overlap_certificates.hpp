#pragma once

#include <engine/mtv/work_budget.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::mtv {

/// A certificate for how deep a shape lies in another one.
///
/// A disc inside the shape: its radius plus the depth of its centre in the other shape, negative
/// outside, is a lower bound on the length of any separating translation. A vertex is a disc of
/// radius 0. A group: for every depth of its centre there are bounds on what its parts certify.
struct OverlapCertificate {
    geometry::Vector centre;
    double least = 0.0;       ///< depth of the centre + this: certified at least by one part
    double most = 0.0;        ///< depth of the centre + this: certified at most by any part
    double spread = 0.0;      ///< largest distance of a leaf's centre
    std::uint32_t first = 0;  ///< of a group: its first part, in the array of all certificates
    std::uint32_t parts = 0;  ///< number of consecutive parts; 0 if it is no group
    bool is_disc = false;     ///< or a group of discs; otherwise a vertex or a group of vertices
    geometry::Vector before = geometry::Vector::Zero();  ///< from a vertex to the one before it
    geometry::Vector after = geometry::Vector::Zero();   ///< and to the one after it
};

/// Appends discs that touch the middle of some edges and are as large as fit inside, all vertices,
/// and groups of eight consecutive ones, of eight such groups, and so on. Lists in `top` those that
/// contain all. Leaves out what is at an edge or a vertex outside of `reach`.
void add_certificates(const simd::TransformedEdges& edges, const geometry::Box& reach,
                      WorkBudget& work, std::vector<OverlapCertificate>& certificates,
                      std::vector<std::uint32_t>& top);

}  // namespace nearfield::mtv
