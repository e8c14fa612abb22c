#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// Copies blended gradients to the read-back buffer: whole tiles, and the four cells around each
/// point. Reads the gradient image, tiles and points; writes the field's buffer.
class CollectGradients {
public:
    CollectGradients(const gpu::Device& device, const ComputeLayout& layout);

    /// Adds the pass; returns the new version of `field`.
    [[nodiscard]] graph::Handle declare(TileGraph& graph, graph::Handle input,
                                        graph::Handle gradients, graph::Handle field) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context) const;

    ComputeShader shader_;
};

}  // namespace nearfield::passes
