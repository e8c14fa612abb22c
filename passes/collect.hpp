#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

namespace nearfield::passes {

/// Collects the samples of the overlap tiles (the paper's search through the image). Reads the hit
/// image and tiles; writes a summary by tile (plan::TileSummary) and, of the tiles that list
/// theirs, the number of samples found and as many of them as there is room for
/// (plan::SampleData), in any order.
class Collect {
public:
    Collect(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass for the tiles of one strategy; returns the new version of `samples`, the
    /// summaries, the count and the list. The host has emptied all three.
    [[nodiscard]] graph::Handle declare(graph::Graph& graph, graph::Handle input,
                                        graph::Handle hits, graph::Handle samples,
                                        IntersectionStrategy strategy) const;

private:
    void record(VkCommandBuffer commands, IntersectionStrategy strategy) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> numbers_;
    gpu::Owned<VkPipeline> colors_;
};

}  // namespace nearfield::passes
