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
/// (plan::SampleData), in any order; of those whose hits are kept the number of every cell found.
class Collect {
public:
    Collect(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// What it writes: summaries, the count and the list, all of which the host has emptied; and
    /// hits that are kept, none where there is no such tile.
    struct Output {
        graph::Handle samples;
        graph::Handle kept_hits;
    };
    /// Adds the pass for the tiles of one strategy; returns the new versions of its output.
    [[nodiscard]] Output declare(graph::Graph& graph, graph::Handle input, graph::Handle hits,
                                 Output output, IntersectionStrategy strategy) const;

private:
    void record(VkCommandBuffer commands, IntersectionStrategy strategy) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> numbers_;
    gpu::Owned<VkPipeline> colors_;
};

}  // namespace nearfield::passes
