#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/compute_layout.hpp>
#include <passes/compute_shader.hpp>

#include <shaders/push.h>
#include <shaders/search.h>
#include <vulkan/vulkan_core.h>

#include <cstdint>

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

/// The shaders that make the boxes of a world's instances, and the levels above them.
struct InstanceShaders {
    InstanceShaders(const gpu::Device& device, const graph::ComputeLayout& layout);

    ComputeShader boxes;
    ComputeShader levels;
};

/// The shaders of all searches between pairs (PairSearch), given or found.
struct SearchShaders {
    SearchShaders(const gpu::Device& device, const graph::ComputeLayout& layout);

    ComputeShader items;
    ComputeShader scan;
    ComputeShader spread;
    ComputeShader edges;
    ComputeShader points;
    ComputeShader summaries;
    ComputeShader pack;
    ComputeShader rows;
};

/// Those that find the pairs of a world's instances, and what can be asked of these alone.
struct FoundPairShaders {
    /// `instance_shaders` have to stay.
    FoundPairShaders(const gpu::Device& device, const graph::ComputeLayout& layout,
                     const InstanceShaders* instance_shaders);

    const InstanceShaders& instances;
    ComputeShader counts;
    ComputeShader lists;
    ComputeShader directions;
    ComputeShader contacts;
    ComputeShader crossings;
    ComputeShader verdicts;
};

}  // namespace nearfield::passes
