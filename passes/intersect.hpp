#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/early_out.hpp>
#include <passes/frame.hpp>
#include <passes/intersection_strategies.hpp>

namespace nearfield::passes {

/// The intersection of Table 1 of the paper, by any of its strategies: the region is cleared by
/// drawing it, B changes the strategy's buffer wherever it is, A changes it again, and what both
/// changed is an intersection. Volumes are filled by parity first and then drawn as the region's
/// rectangle under the fill; boundaries are drawn as offset polygons, which overlap one another:
/// the first of A's at a sample counts and leaves its number.
class Intersect {
public:
    Intersect(const gpu::Device& device, VkPipelineLayout layout,
              const IntersectionStrategies& strategies, const EarlyOut& early_out,
              const Frame& frame)
        : device_(&device),
          layout_(layout),
          strategies_(&strategies),
          early_out_(&early_out),
          frame_(&frame) {}

    /// Adds the pass that draws every overlap tile of one strategy. Reads the mesh; returns the hit
    /// image: a colour (plan::white: an intersection) and, where A takes part by its boundary, the
    /// run of A's edges that is near (plan::Round::runs) above it.
    graph::Handle declare(graph::Graph& graph, graph::Handle mesh, VkExtent2D extent,
                          IntersectionStrategy strategy) const;

private:
    void record(VkCommandBuffer commands, IntersectionStrategy strategy) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const IntersectionStrategies* strategies_;
    const EarlyOut* early_out_;
    const Frame* frame_;
};

}  // namespace nearfield::passes
