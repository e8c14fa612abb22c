#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// Distance fields of the compute technique (plan::ComputeWork). Each block of 16 x 16 cells has a
/// list of the edges that can be nearest in it, which its cells search. One dispatch covers all
/// blocks of all fields of a tile batch. No thread waits for another: on software drivers, barriers
/// within a workgroup and shared memory cost the most.
class Blocks {
public:
    Blocks(const gpu::Device& device, const ComputeLayout& layout);

    /// Adds the pass that writes the signed distances of cells; reads the masks for the signs.
    /// Returns the new version of `field`, as the others do.
    [[nodiscard]] graph::Handle declare_values(TileGraph& graph, graph::Handle input,
                                               graph::Handle scratch, graph::Handle field) const;
    /// Adds the pass that writes the nearest features of cells.
    [[nodiscard]] graph::Handle declare_features(TileGraph& graph, graph::Handle input,
                                                 graph::Handle scratch, graph::Handle field) const;
    /// Adds the pass for points of fields; it writes the same words as ResolveFieldPoints.
    [[nodiscard]] graph::Handle declare_points(TileGraph& graph, graph::Handle input,
                                               graph::Handle scratch, graph::Handle field) const;

private:
    void record_values(VkCommandBuffer commands, const RecordContext& context) const;
    void record_features(VkCommandBuffer commands, const RecordContext& context) const;
    void record_points(VkCommandBuffer commands, const RecordContext& context) const;

    ComputeShader values_;
    ComputeShader features_;
    ComputeShader points_;
};

}  // namespace nearfield::passes
