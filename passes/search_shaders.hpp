#pragma once

#include <engine/gpu/device.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_shader.hpp>

#include <shaders/push.h>
#include <shaders/search.h>
#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <string>

namespace nearfield::passes {

/// Bytes of the arguments of one stage's dispatch.
inline constexpr VkDeviceSize search_argument_bytes =
    plan::words_of_arguments * sizeof(std::uint32_t);

/// The workgroups that scan the blocks of so many elements.
[[nodiscard]] constexpr std::uint32_t scan_groups(std::uint64_t elements) {
    constexpr std::uint64_t scanned = std::uint64_t{plan::scan_block} * plan::search_block;
    return elements == 0 ? 1 : static_cast<std::uint32_t>((elements + scanned - 1) / scanned);
}
/// The same of the threads that look at so many points.
[[nodiscard]] constexpr std::uint32_t scan_groups_of_points(std::uint32_t points) {
    return scan_groups((std::uint64_t{points} + plan::points_per_thread - 1) /
                       plan::points_per_thread);
}

/// The specialization constants of the shaders that include search.glsl. `finds_pairs`: the
/// directions are found by the device, and not given in the input.
[[nodiscard]] std::array<VkBool32, 2> search_constants(const gpu::Device& device, bool finds_pairs);

/// The shaders that search for boundary points: in the directions of a batch (PointSearch), or
/// between all pairs of a world (PairSearch).
struct SearchShaders {
    /// `prefix`: of the names of the pipelines.
    SearchShaders(const gpu::Device& device, const ComputeLayout& layout, bool finds_pairs,
                  const std::string& prefix);

    ComputeShader items;
    ComputeShader scan;
    ComputeShader spread;
    ComputeShader edges;
    ComputeShader points;
    ComputeShader pack;
};

}  // namespace nearfield::passes
