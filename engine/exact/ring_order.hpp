#pragma once

#include <engine/exact/edge_kernels.hpp>
#include <engine/geometry/polygon.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::exact {

/// The rings of a polygon so that those near each other come one after the other, whatever the
/// order they were handed over in. Keeps its memory.
class RingOrder {
public:
    /// `edges`: the polygon's, in its order, wherever it is placed; `box`: the box around them.
    /// Valid until the next call.
    [[nodiscard]] std::span<const std::uint32_t> find(const geometry::Polygon& polygon,
                                                      const EdgeArrays& edges,
                                                      const geometry::Box& box);

private:
    void sort_by_byte(std::uint32_t byte);

    std::vector<std::uint32_t> rings_;
    std::vector<std::uint32_t> others_;    // rings_ as they come to be; scratch
    std::vector<std::uint16_t> on_curve_;  // by ring: where it lies on a curve through all places
};

}  // namespace nearfield::exact
