#pragma once

#include <engine/simd/aabb_tree.hpp>
#include <engine/simd/edge_kernels.hpp>

#include <cstddef>
#include <cstdint>

namespace nearfield::simd {

/// A part of an edge.
struct ParameterInterval {
    double from = 0.0;  ///< parameter along the edge
    double to = 1.0;
};

/// Maximum number of intervals per edge.
inline constexpr std::uint32_t max_intervals = 32;

namespace kernels {

/// Finds the parts of an edge within `reach` (> 0) of other edges: all of them, and hardly any that
/// are farther away than 1.5 times `reach`. The intervals are unordered and may overlap; if there
/// are too many, the result is one interval for the whole edge. Returns their number. `found`:
/// capacity max_intervals.
[[nodiscard]] std::uint32_t find_intervals_near(const EdgeArrays& edges, std::uint32_t edge,
                                                const EdgeArrays& others, double reach,
                                                ParameterInterval* found);
[[nodiscard]] std::uint32_t find_intervals_near(const EdgeArrays& edges, std::uint32_t edge,
                                                const AabbTree& others, double reach,
                                                VisitsLeft& left, ParameterInterval* found);

}  // namespace kernels

}  // namespace nearfield::simd
