#pragma once

#include <engine/exact/box_tree.hpp>
#include <engine/exact/edge_kernels.hpp>

#include <cstddef>
#include <cstdint>

namespace nearfield::exact {

/// A part of an edge.
struct Stretch {
    double from = 0.0;  ///< of the way along the edge
    double to = 1.0;
};

/// More of one edge are not told apart.
inline constexpr std::uint32_t most_stretches = 32;

namespace kernels {

/// Finds where an edge comes as close to others as `reach`, above 0: all such places, and hardly
/// any that are farther away than 1.5 times that. In any order, and they may overlap; where there
/// were too many, one of the whole edge. Returns how many there are. `found`: room for
/// most_stretches.
[[nodiscard]] std::uint32_t find_stretches_near(const EdgeArrays& edges, std::uint32_t edge,
                                                const EdgeArrays& others, double reach,
                                                Stretch* found);
[[nodiscard]] std::uint32_t find_stretches_near(const EdgeArrays& edges, std::uint32_t edge,
                                                const BoxTree& others, double reach,
                                                Stretch* found);

}  // namespace kernels

}  // namespace nearfield::exact
