#pragma once

#include <engine/gpu/device.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_shader.hpp>
#include <passes/record_context.hpp>

namespace nearfield::passes {

/// The bit masks of the compute technique (shaders/compute_work.h), in its scratch memory: the
/// signs of fields, the volumes and boundaries of intersections, and the search for the samples
/// that two masks share. The device reads the shapes' own edges, chunk by chunk.
class Masks {
public:
    Masks(const gpu::Device& device, const ComputeLayout& layout);

    /// Adds the pass that clears masks and the edges of cells; the first of all passes that use the
    /// scratch memory. It waits for earlier use of that memory on the device, so tile batches may
    /// follow each other in a command buffer or in a queue. Like all functions below, it returns
    /// the new version of the scratch memory.
    [[nodiscard]] graph::Handle declare_clear(TileGraph& graph, graph::Handle scratch) const;
    /// Adds the pass that puts shapes into masks: of volumes it marks the edges.
    [[nodiscard]] graph::Handle declare_shapes(TileGraph& graph, graph::Handle shapes,
                                               graph::Handle scratch) const;
    /// Adds the pass that fills the rows of fields.
    [[nodiscard]] graph::Handle declare_fill(TileGraph& graph, graph::Handle input,
                                             graph::Handle scratch) const;
    struct Collected {
        graph::Handle input;
        graph::Handle scratch;
        graph::Handle samples;
    };
    /// Adds the pass that fills the rows of intersections and writes the same output as Collect.
    [[nodiscard]] graph::Handle declare_collect(TileGraph& graph, Collected buffers) const;

private:
    void record_clear(VkCommandBuffer commands, const RecordContext& context) const;
    void record_shapes(VkCommandBuffer commands, const RecordContext& context) const;
    void record_rows(VkCommandBuffer commands, const RecordContext& context) const;
    void record_collect(VkCommandBuffer commands, const RecordContext& context) const;

    const gpu::Device* device_;
    ComputeShader shapes_;
    ComputeShader rows_;
    ComputeShader collect_;
};

}  // namespace nearfield::passes
