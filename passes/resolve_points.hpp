#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

namespace nearfield::passes {

/// Point depth (section 2.2.4 of the paper): for every point of the round whether it lies inside B,
/// which of B's edges is nearest, and whether that is the only answer within the margin.
/// Reads the feature and sign images, tiles, edge lists and points; writes one word a point
/// (plan::point_inside and so on).
class ResolvePoints {
public:
    ResolvePoints(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass. Which buffers and images the frame's descriptor set holds is the caller's
    /// affair.
    void declare(graph::Graph& graph, graph::Handle input, graph::Handle features,
                 graph::Handle sign, graph::Handle results) const;
    /// The same from the lists alone, without images (the compute technique).
    void declare_by_lists(graph::Graph& graph, graph::Handle input, graph::Handle results) const;

private:
    void record(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline,
                VkDescriptorSet set) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> by_images_;
    gpu::Owned<VkPipeline> by_lists_;
};

}  // namespace nearfield::passes
