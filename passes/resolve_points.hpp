#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// Point depth (section 2.2.4 of the paper): for every point of the tile batch, whether it lies
/// inside B, which of B's edges is nearest, and whether that is the only answer within the margin.
/// Reads tiles, edge lists and points; writes one word per point (plan::point_inside and the other
/// flags).
class ResolvePoints {
public:
    ResolvePoints(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// Adds the pass. `features`, `sign`: images.
    void declare(TileGraph& graph, graph::Handle input, graph::Handle results,
                 graph::Handle features, graph::Handle sign) const;

private:
    ComputeShader shader_;
};

}  // namespace nearfield::passes
