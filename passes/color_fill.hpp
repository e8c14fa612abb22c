#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The sign of the distance field in a colour buffer (section 2.2.2 of the paper, second encoding):
/// the inside of B is white. Parity by blending: each quad of the fill mesh replaces a colour by
/// one minus it. Reads the mesh; writes the white image in every field tile with this encoding.
class ColorFill {
public:
    ColorFill(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass);

    /// Adds the pass; returns the image, sampled as unsigned bytes: 255 inside, 0 outside.
    graph::Handle declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    gpu::Owned<VkPipeline> clear_;
    gpu::Owned<VkPipeline> parity_;
};

/// The colour format of the pass.
inline constexpr VkFormat white_format = VK_FORMAT_R8_UNORM;

/// The bits of a texel that are set inside B.
inline constexpr std::uint32_t white_mask = 0xff;

}  // namespace nearfield::passes
