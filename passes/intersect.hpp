#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/frame.hpp>
#include <passes/stencil_pipelines.hpp>

namespace nearfield::passes {

/// The stencil method of Table 1 of the paper: clear by drawing the region, B raises the stencil
/// to 1, A raises it to 2 where it is 1, and 2 is an intersection. Volumes are filled by parity
/// first and then counted once; boundaries are drawn as offset polygons.
/// Reads the mesh; writes the hit image: where A takes part by its boundary the run of A's edges
/// that is near (plan::Round::runs), else 0; no_feature where there is no intersection.
class Intersect {
public:
    Intersect(const gpu::Device& device, VkPipelineLayout layout, const StencilPipelines& pipelines,
              const Frame& frame)
        : device_(&device), layout_(layout), pipelines_(&pipelines), frame_(&frame) {}

    /// Adds the pass; returns the hit image.
    graph::Handle declare(graph::Graph& graph, graph::Handle mesh, VkExtent2D extent) const;

private:
    void record(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const StencilPipelines* pipelines_;
    const Frame* frame_;
};

}  // namespace nearfield::passes
