#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

namespace nearfield::passes {

/// Collects the samples of all overlap tiles into one list (the paper's search through the image).
/// Reads the hit image and tiles; writes the number of samples found and as many of them as there
/// is room for (plan::SampleData), in any order.
class Collect {
public:
    Collect(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass. The host has set the count to zero.
    void declare(graph::Graph& graph, graph::Handle input, graph::Handle hits,
                 graph::Handle samples) const;

private:
    void record(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> pipeline_;
};

}  // namespace nearfield::passes
