#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/graph/graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/frame.hpp>

#include <cstdint>

namespace nearfield::passes {

/// The compute technique's fields (plan::ComputeWork): each block of 16 x 16 cells has a list of
/// the edges that can be nearest in it, and its cells look through that. All blocks of all tiles of
/// all fields of a round in one dispatch, and no thread waits for another: barriers within a group
/// and shared memory are what costs most on a CPU.
class Blocks {
public:
    Blocks(const gpu::Device& device, const ComputeLayout& layout, const Frame& frame);

    /// Adds the pass that writes the signed distances of cells; reads the masks for the signs.
    /// Returns the field's buffer, as the others do.
    [[nodiscard]] graph::Handle declare_values(graph::Graph& graph, graph::Handle input,
                                               graph::Handle scratch, graph::Handle field) const;
    /// The same of their nearest features.
    [[nodiscard]] graph::Handle declare_features(graph::Graph& graph, graph::Handle input,
                                                 graph::Handle scratch, graph::Handle field) const;
    /// The same for points of fields, and what passes/resolve_field_points.hpp writes.
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
    const Frame* frame_;
    gpu::Owned<VkPipeline> values_;
    gpu::Owned<VkPipeline> features_;
    gpu::Owned<VkPipeline> points_;
};

}  // namespace nearfield::passes
