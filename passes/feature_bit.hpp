#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The distance mesh of B with the sign as the top bit of the feature id (section 2.2.2 of the
/// paper, third encoding). Ids are colours of four bytes: the fill inverts the highest byte by
/// blending, as in ColorFill, and the mesh writes the id to the other three with the depth test
/// LESS. Reads the mesh; writes the image of ids and signs in every field tile with this encoding.
class FeatureBit {
public:
    FeatureBit(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass);

    /// Adds the pass; returns the image, sampled as one unsigned number per texel.
    graph::Handle declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    gpu::Owned<VkPipeline> clear_;
    gpu::Owned<VkPipeline> parity_;
    gpu::Owned<VkPipeline> draw_;
};

/// The colour format of the pass, for its render pass; depth is distance_depth_format.
inline constexpr VkFormat signed_feature_format = VK_FORMAT_R8G8B8A8_UNORM;

}  // namespace nearfield::passes
