#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/graph.hpp>
#include <engine/plan/hand_over.hpp>
#include <nearfield/context.hpp>
#include <passes/compute_layout.hpp>

#include <memory>
#include <span>
#include <string>

namespace nearfield::passes {

/// The last pass of a field that stays on the device: copies what was resolved for its cells into
/// images for the host's shaders, in a graph to itself, since these belong to the batch and not to
/// the recipe. The graph leaves them as the shaders of users find them.
class HandOverField {
public:
    HandOverField(const gpu::Device& device, const ComputeLayout& layout);
    HandOverField(const HandOverField&) = delete;
    HandOverField& operator=(const HandOverField&) = delete;

    /// What a field's pass records from.
    struct Item {
        const plan::FieldHandOver* field = nullptr;
        std::span<const plan::FieldPartHandOver> parts;
        std::span<const VkDescriptorSet> sets;  ///< by part
        VkBuffer words = VK_NULL_HANDLE;        ///< of fields, as the rounds left them
        VkImage signed_distance = VK_NULL_HANDLE;
        VkImage feature = VK_NULL_HANDLE;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item);

    [[nodiscard]] std::string print(GraphFormat format) const;

private:
    void dispatch(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    gpu::Owned<VkPipeline> pipeline_;
    graph::Graph graph_;
    graph::Handle words_;
    graph::Handle signed_distance_;
    graph::Handle feature_;
    std::unique_ptr<graph::Executor> executor_;
    Item item_;
};

}  // namespace nearfield::passes
