#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/simd/edge_kernels.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::simd {

/// Orders the rings of a polygon so that nearby rings follow each other, whatever order they come
/// in. Reuses its memory.
class MortonOrder {
public:
    /// `edges`: the polygon's transformed edges, in its order; `box`: their bounding box. Valid
    /// until the next call.
    [[nodiscard]] std::span<const std::uint32_t> find(const geometry::Polygon& polygon,
                                                      const EdgeArrays& edges,
                                                      const geometry::Box& box);

    /// Host memory, in bytes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(std::uint32_t) * (rings_.capacity() + others_.capacity()) +
               sizeof(std::uint16_t) * on_curve_.capacity();
    }

private:
    void sort_by_byte(std::uint32_t byte);

    std::vector<std::uint32_t> rings_;
    std::vector<std::uint32_t> others_;    // scratch for sorting rings_
    std::vector<std::uint16_t> on_curve_;  // by ring: its position on the Morton curve
};

}  // namespace nearfield::simd
