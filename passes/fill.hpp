#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>
#include <passes/stencil_pipelines.hpp>

namespace nearfield::passes {

/// Polygon fill of B by stencil parity: the sign of the distance field (section 2.2.2 of the paper,
/// first encoding). Reads the mesh; writes the sign image, 1 inside B and 0 outside, in every tile
/// with a distance field of this encoding.
class Fill {
public:
    Fill(const gpu::Device& device, VkPipelineLayout layout, const StencilPipelines& pipelines)
        : device_(&device), layout_(layout), pipelines_(&pipelines) {}

    /// Adds the pass; returns the sign image.
    graph::Handle declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const StencilPipelines* pipelines_;
};

/// The bits of a texel that are set inside B.
inline constexpr std::uint32_t filled_mask = 1;

}  // namespace nearfield::passes
