#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>
#include <passes/resolve_field.hpp>

namespace nearfield::passes {

/// The cells from which a field is reconstructed at points (section 2.2.2 of the paper: only the
/// requested pixels are read back), and the feature nearest to each point. Reads the images, tiles,
/// edge lists and points; writes a few words per point (plan::FieldParts).
class ResolveFieldPoints {
public:
    ResolveFieldPoints(const gpu::Device& device, const ComputeLayout& layout);

    /// Adds the pass; returns the new version of `field`.
    [[nodiscard]] graph::Handle declare(TileGraph& graph, graph::Handle input,
                                        const FieldImages& images, graph::Handle field) const;

private:
    void record(VkCommandBuffer commands, const RecordContext& context) const;

    ComputeShader shader_;
};

}  // namespace nearfield::passes
