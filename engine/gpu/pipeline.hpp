#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace nearfield::gpu {

/// SPIR-V words embedded at build time.
using Spirv = std::span<const std::uint32_t>;

/// `constants`: replace the specialization constants 0, 1, ..., all of type bool; at most two.
[[nodiscard]] Owned<VkPipeline> make_compute_pipeline(const Device& device, VkPipelineLayout layout,
                                                      Spirv shader, const std::string& name,
                                                      std::span<const VkBool32> constants = {});

/// The differences between the library's graphics pipelines. All draw triangle lists of
/// geometry::MeshVertex, or of raster::TileVertex where the vertex shader reads the rectangle of
/// its tile (location 3), with viewport, scissor, stencil masks and stencil reference as dynamic
/// state.
struct GraphicsPipelineDescription {
    std::string name;
    VkRenderPass render_pass = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    Spirv vertex_shader;
    Spirv fragment_shader;  ///< empty: no fragment shader, no colour is written
    /// How colours are combined with those in the image, and which channels are written; empty:
    /// they replace the colour in all channels.
    std::optional<VkPipelineColorBlendAttachmentState> blend;
    bool logic_or = false;    ///< colours are combined by bitwise OR; needs the feature logicOp
    bool depth_test = false;  ///< and depth write
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;
    bool stencil_test = false;
    VkCompareOp stencil_compare = VK_COMPARE_OP_ALWAYS;
    VkStencilOp stencil_pass = VK_STENCIL_OP_KEEP;  ///< keeps where the stencil or depth test fails
};

[[nodiscard]] Owned<VkPipeline> make_graphics_pipeline(const Device& device,
                                                       const GraphicsPipelineDescription& what);

}  // namespace nearfield::gpu
