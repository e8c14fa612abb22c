#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/record_context.hpp>

#include <cstdint>

namespace nearfield::passes {

/// Distance fields of the compute technique (plan::ComputeWork). Each block of 16 x 16 cells has a
/// list of the edges that can be nearest in it, which its cells search. One dispatch covers all
/// blocks of all fields of a tile batch. No thread waits for another: on software drivers, barriers
/// within a workgroup and shared memory cost the most.
class Blocks {
public:
    Blocks(const gpu::Device& device, const ComputeLayout& layout, const RecordContext& context);

    /// Adds the pass that writes the signed distances of cells; reads the masks for the signs.
    /// Returns the new version of `field`, as the others do.
    [[nodiscard]] graph::Handle declare_values(graph::Graph& graph, graph::Handle input,
                                               graph::Handle scratch, graph::Handle field) const;
    /// Adds the pass that writes the nearest features of cells.
    [[nodiscard]] graph::Handle declare_features(graph::Graph& graph, graph::Handle input,
                                                 graph::Handle scratch, graph::Handle field) const;
    /// Adds the pass for points of fields; it writes the same words as ResolveFieldPoints.
    [[nodiscard]] graph::Handle declare_points(graph::Graph& graph, graph::Handle input,
                                               graph::Handle scratch, graph::Handle field) const;

private:
    [[nodiscard]] graph::Handle declare(graph::Graph& graph, const char* name, graph::Handle input,
                                        graph::Handle scratch, graph::Handle field,
                                        graph::Record record) const;
    void record_values(VkCommandBuffer commands) const;
    void record_features(VkCommandBuffer commands) const;
    void record_points(VkCommandBuffer commands) const;
    void bind(VkCommandBuffer commands, const gpu::Owned<VkPipeline>& pipeline,
              VkDescriptorSet set) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    const RecordContext* context_;
    gpu::Owned<VkPipeline> values_;
    gpu::Owned<VkPipeline> features_;
    gpu::Owned<VkPipeline> points_;
};

}  // namespace nearfield::passes
