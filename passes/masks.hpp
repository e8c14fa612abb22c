#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The bit masks of the compute technique (plan::ComputeWork), in its scratch memory: fills with
/// one thread per edge and then one per row, offset polygons with one thread each, and the search
/// for the samples that two masks share. Computed in integers on the vertices that the raster would
/// draw, so the result equals that of its fill and its strategies bit for bit.
class Masks {
public:
    Masks(const gpu::Device& device, const ComputeLayout& layout);

    /// Adds the pass that clears masks and runs; the first of all passes that use the scratch
    /// memory. It waits for earlier use of that memory on the device, so tile batches may follow
    /// each other in a command buffer or in a queue. Like all functions below, it returns the new
    /// version of its output.
    [[nodiscard]] graph::Handle declare_clear(TileGraph& graph, graph::Handle scratch) const;
    /// Adds the pass that marks edges of the input.
    [[nodiscard]] graph::Handle declare_marks(TileGraph& graph, graph::Handle input,
                                              graph::Handle scratch) const;
    /// Adds the pass that fills rows, once all edges are marked.
    [[nodiscard]] graph::Handle declare_fill(TileGraph& graph, graph::Handle input,
                                             graph::Handle scratch) const;
    /// A's come after all of B's masks: samples of A's boundary count only where those are set.
    [[nodiscard]] graph::Handle declare_boundaries(TileGraph& graph, graph::Handle input,
                                                   graph::Handle scratch, bool of_a) const;
    /// Adds the pass that writes the same output as Collect.
    [[nodiscard]] graph::Handle declare_collect(TileGraph& graph, graph::Handle input,
                                                graph::Handle scratch, graph::Handle samples) const;

private:
    void record_clear(VkCommandBuffer commands, const RecordContext& context) const;
    void record_edges(VkCommandBuffer commands, const RecordContext& context) const;
    void record_rows(VkCommandBuffer commands, const RecordContext& context) const;
    void record_collect(VkCommandBuffer commands, const RecordContext& context) const;
    void record_polygons(VkCommandBuffer commands, const RecordContext& context, bool of_a) const;

    const gpu::Device* device_;
    ComputeShader edges_;
    ComputeShader rows_;
    ComputeShader polygons_;
    ComputeShader collect_;
};

}  // namespace nearfield::passes
