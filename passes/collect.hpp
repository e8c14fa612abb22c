#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// Collects the samples of the overlap tiles (the paper's search through the image, section 2.2.1).
/// Reads the hit image and the tiles. Writes a summary per tile (plan::TileSummary); for tiles that
/// list their samples, the number of samples and as many as there is space for (plan::SampleData),
/// in any order; for tiles that keep their hits, the number found at every cell.
class Collect {
public:
    Collect(const gpu::Device& device, const ComputeLayout& layout);

    /// The outputs: summaries, count and list, which the host has initialised; and the kept hits, a
    /// null handle if no tile keeps them.
    struct Output {
        graph::Handle samples;
        graph::Handle kept_hits;
    };
    /// Adds the pass for the tiles of one strategy.
    void declare(TileGraph& graph, graph::Handle input, graph::Handle hits, Output& output,
                 IntersectionStrategy strategy) const;

private:
    ComputeShader numbers_;
    ComputeShader colors_;
};

}  // namespace nearfield::passes
