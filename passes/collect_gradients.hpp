#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

namespace nearfield::passes {

/// Copies blended gradients to where the host reads them: whole tiles, and the four cells around
/// each point. Reads the gradient image, tiles and points; writes the field's buffer.
class CollectGradients {
public:
    CollectGradients(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass; returns the field's buffer.
    [[nodiscard]] graph::Handle declare(graph::Graph& graph, graph::Handle input,
                                        graph::Handle gradients, graph::Handle field) const;

private:
    void record(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> pipeline_;
};

}  // namespace nearfield::passes
