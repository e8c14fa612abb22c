#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/graph/graph.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The gradient of the whole distance image in three blended draws (section 2.2.3 of the paper):
/// the image shifted by one pixel, minus the image shifted by one pixel the other way, times one
/// half. Both components in one draw, x in red and y in green. Reads the field's values; writes the
/// gradient image in every tile with blended gradients.
class Gradient {
public:
    Gradient(const gpu::Device& device, const graph::ComputeLayout& layout,
             VkRenderPass render_pass);

    /// Adds the pass; returns the gradient image.
    graph::Handle declare(TileGraph& graph, graph::Handle mesh, graph::Handle field,
                          VkExtent2D extent) const;

private:
    void record(const graph::PassCommands& commands, const RecordContext& context) const;

    const gpu::Device* device_;
    gpu::Owned<VkPipelineLayout> layout_;
    gpu::Owned<VkPipeline> shifted_;
    gpu::Owned<VkPipeline> subtract_;
    gpu::Owned<VkPipeline> multiply_;
};

}  // namespace nearfield::passes
