#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

#include <cstdint>

namespace nearfield::passes {

/// The compute technique's distances (plan::ComputeWork): blocks of 8 x 8 cells list the edges that
/// can be nearest in them, each cell looks through its block's list only. All blocks of all tiles
/// of all fields of a round in one dispatch, and no thread waits for another: barriers within a
/// group and shared memory are what costs most on a CPU.
class Blocks {
public:
    Blocks(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass that lists edges by block; returns the new version of the scratch memory.
    [[nodiscard]] graph::Handle declare_lists(graph::Graph& graph, graph::Handle input,
                                              graph::Handle scratch) const;
    /// Adds the pass that writes what passes/resolve_field.hpp writes; reads the lists, and the
    /// masks for the signs. Returns the field's buffer.
    [[nodiscard]] graph::Handle declare_cells(graph::Graph& graph, graph::Handle input,
                                              graph::Handle scratch, graph::Handle field) const;
    /// The same for points of fields, and what passes/resolve_field_points.hpp writes; without the
    /// lists of blocks.
    [[nodiscard]] graph::Handle declare_points(graph::Graph& graph, graph::Handle input,
                                               graph::Handle scratch, graph::Handle field) const;

private:
    void record_blocks(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline,
                       std::uint32_t threads_per_block) const;
    void record_points(VkCommandBuffer commands) const;
    void bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const Frame* frame_;
    gpu::Owned<VkPipeline> lists_;
    gpu::Owned<VkPipeline> cells_;
    gpu::Owned<VkPipeline> points_;
};

}  // namespace nearfield::passes
