#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

#include <cstdint>

namespace nearfield::passes {

/// The compute technique's bit masks (plan::ComputeWork), in its scratch memory: fills by one
/// thread an edge and one a row, offset polygons by one thread each, and the search for what two
/// masks share. Decided in integers on the vertices that the raster would draw, so bit for bit what
/// its fill and its strategies find.
class Masks {
public:
    Masks(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass that empties masks and runs; first of all that use the scratch memory. It
    /// waits for what the device still does with it, so one round may follow another in a command
    /// buffer or in a queue. As all below it returns the new version of what it writes.
    [[nodiscard]] graph::Handle declare_clear(graph::Graph& graph, graph::Handle scratch) const;
    /// Marks edges, then fills rows.
    [[nodiscard]] graph::Handle declare_fill(graph::Graph& graph, graph::Handle input,
                                             graph::Handle scratch) const;
    [[nodiscard]] graph::Handle declare_boundaries_b(graph::Graph& graph, graph::Handle input,
                                                     graph::Handle scratch) const;
    /// After all of B's masks: of A's boundary only what they cover counts.
    [[nodiscard]] graph::Handle declare_boundaries_a(graph::Graph& graph, graph::Handle input,
                                                     graph::Handle scratch) const;
    /// Writes what passes/collect.hpp writes.
    [[nodiscard]] graph::Handle declare_collect(graph::Graph& graph, graph::Handle input,
                                                graph::Handle scratch, graph::Handle samples) const;

private:
    void record_clear(VkCommandBuffer commands) const;
    void record_polygons(VkCommandBuffer commands, bool of_a) const;
    void bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline) const;
    /// One thread for each of `count` elements; the shader's push constants are the range of
    /// elements and then `words`.
    template <std::size_t Count>
    void dispatch(VkCommandBuffer commands, std::uint32_t count,
                  const std::uint32_t (&words)[Count]) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> edges_;
    gpu::Owned<VkPipeline> rows_;
    gpu::Owned<VkPipeline> polygons_;
    gpu::Owned<VkPipeline> collect_;
};

}  // namespace nearfield::passes
