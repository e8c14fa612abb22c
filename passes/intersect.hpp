#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/early_out.hpp>
#include <passes/intersection_strategies.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The intersection of Table 1 of the paper, by any of its strategies. A draw clears the region, B
/// changes the strategy's buffer at its samples, A changes it again, and the samples that both
/// changed are the intersection. Volumes are filled by parity first, then drawn as the region's
/// rectangle where the fill is set. Boundaries are drawn as offset polygons, which overlap each
/// other: at each sample the first of A's counts and writes its number.
class Intersect {
public:
    Intersect(const gpu::Device& device, VkPipelineLayout layout,
              const IntersectionStrategies& strategies, const EarlyOut& early_out)
        : device_(&device), layout_(layout), strategies_(&strategies), early_out_(&early_out) {}

    /// Adds the pass that draws every overlap tile of one strategy. Reads the mesh; returns the hit
    /// image: a colour in the low byte (plan::white: an intersection) and, if A takes part by its
    /// boundary, the number of the run of A's edges nearby (plan::TileBatch::runs) above it.
    graph::Handle declare(TileGraph& graph, graph::Handle mesh, VkExtent2D extent,
                          IntersectionStrategy strategy) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context,
                IntersectionStrategy strategy) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const IntersectionStrategies* strategies_;
    const EarlyOut* early_out_;
};

}  // namespace nearfield::passes
