#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/record_context.hpp>

#include <cstdint>

namespace nearfield::passes {

/// The bit masks of the compute technique (plan::ComputeWork), in its scratch memory: fills with
/// one thread per edge and then one per row, offset polygons with one thread each, and the search
/// for the samples that two masks share. Computed in integers on the vertices that the raster would
/// draw, so the result equals that of its fill and its strategies bit for bit.
class Masks {
public:
    Masks(const gpu::Device& device, const ComputeLayout& layout, const RecordContext& context);

    /// Adds the pass that clears masks and runs; the first of all passes that use the scratch
    /// memory. It waits for earlier use of that memory on the device, so tile batches may follow
    /// each other in a command buffer or in a queue. Like all functions below, it returns the new
    /// version of its output.
    [[nodiscard]] graph::Handle declare_clear(graph::Graph& graph, graph::Handle scratch) const;
    /// Adds the passes that mark edges, then fill rows.
    [[nodiscard]] graph::Handle declare_fill(graph::Graph& graph, graph::Handle input,
                                             graph::Handle scratch) const;
    [[nodiscard]] graph::Handle declare_boundaries_b(graph::Graph& graph, graph::Handle input,
                                                     graph::Handle scratch) const;
    /// After all of B's masks: samples of A's boundary count only where those are set.
    [[nodiscard]] graph::Handle declare_boundaries_a(graph::Graph& graph, graph::Handle input,
                                                     graph::Handle scratch) const;
    /// Adds the pass that writes the same output as Collect.
    [[nodiscard]] graph::Handle declare_collect(graph::Graph& graph, graph::Handle input,
                                                graph::Handle scratch, graph::Handle samples) const;

private:
    void record_clear(VkCommandBuffer commands) const;
    void record_polygons(VkCommandBuffer commands, bool of_a) const;
    void bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline) const;
    /// Dispatches one thread for each of `count` elements; the push constants are the range of
    /// elements, then `words`.
    template <std::size_t Count>
    void dispatch(VkCommandBuffer commands, std::uint32_t count,
                  const std::uint32_t (&words)[Count]) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const RecordContext* context_;
    gpu::Owned<VkPipeline> edges_;
    gpu::Owned<VkPipeline> rows_;
    gpu::Owned<VkPipeline> polygons_;
    gpu::Owned<VkPipeline> collect_;
};

}  // namespace nearfield::passes
