#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

namespace nearfield::passes {

/// Signed distance at the centre of every cell of the field tiles (section 2.2.2 of the paper), in
/// cells. Reads the feature and sign images, tiles and edge lists; writes the values, tile after
/// tile.
class ResolveField {
public:
    ResolveField(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass.
    void declare(graph::Graph& graph, graph::Handle input, graph::Handle features,
                 graph::Handle sign, graph::Handle values) const;

private:
    void record(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> pipeline_;
};

}  // namespace nearfield::passes
