#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/pipeline.hpp>

#include <string>

namespace nearfield::passes {

/// The format of images of unsigned numbers: signs, edges, features.
inline constexpr VkFormat number_format = VK_FORMAT_R32_UINT;

/// The pipelines of a polygon fill. The low stencil bits count; the two high bits hold the parity
/// of a fill in progress.
struct StencilPipelines {
    /// `fragment_shader` writes the colour; `colors` is for the names of the pipelines.
    StencilPipelines(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass,
                     gpu::Spirv fragment_shader, const std::string& colors);

    gpu::Owned<VkPipeline> clear;   ///< stencil := reference, colour := value
    gpu::Owned<VkPipeline> parity;  ///< invert the written bits
    gpu::Owned<VkPipeline> mark;  ///< where the compared bits equal the reference: colour := value
};

namespace stencil_bits {
inline constexpr std::uint32_t all = 0xff;
inline constexpr std::uint32_t counter = 0x0f;
inline constexpr std::uint32_t parity_a = 0x40;
inline constexpr std::uint32_t parity_b = 0x80;
}  // namespace stencil_bits

}  // namespace nearfield::passes
