#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// Collects the samples of the overlap tiles (the paper's search through the image, section 2.2.1).
/// Reads the hit image and the tiles. Writes a summary per tile (plan::TileSummary); for tiles that
/// list their samples, the number of samples and as many as there is space for (plan::SampleData),
/// in any order.
class Collect {
public:
    Collect(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// Adds the pass for the tiles of one strategy. `samples`: summaries, count and list, which the
    /// host has initialised.
    void declare(TileGraph& graph, graph::Handle input, graph::Handle hits, graph::Handle& samples,
                 IntersectionStrategy strategy) const;

private:
    ComputeShader numbers_;
    ComputeShader colors_;
};

}  // namespace nearfield::passes
