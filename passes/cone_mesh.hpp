#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The distance mesh of B (section 2.2.2 of the paper): tents and cones with the depth test LESS.
/// Reads the mesh; writes the feature image (the edge in the tile's list of nearest edges that won
/// the depth test) in every tile with a distance field, except those that FeatureBit draws. The
/// depth image is discarded: passes that need the distance compute it from the feature.
class ConeMesh {
public:
    ConeMesh(const gpu::Device& device, VkPipelineLayout layout, VkRenderPass render_pass);

    /// Adds the pass; returns the feature image.
    graph::Handle declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    gpu::Owned<VkPipeline> clear_;
    gpu::Owned<VkPipeline> draw_;
};

/// The depth format of the pass.
inline constexpr VkFormat distance_depth_format = VK_FORMAT_D32_SFLOAT;

}  // namespace nearfield::passes
