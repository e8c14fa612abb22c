#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/graph.hpp>
#include <engine/plan/hand_over.hpp>
#include <nearfield/context.hpp>
#include <passes/compute_layout.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace nearfield::passes {

/// The last passes of points whose records stay on the device: count, place, write, in a graph to
/// themselves (see HandOverField).
class HandOverRecords {
public:
    HandOverRecords(const gpu::Device& device, const ComputeLayout& layout);
    HandOverRecords(const HandOverRecords&) = delete;
    HandOverRecords& operator=(const HandOverRecords&) = delete;

    /// What a query's passes record from.
    struct Item {
        const plan::RecordsHandOver* records = nullptr;
        std::span<const plan::PointRunHandOver> runs;
        std::span<const std::uint32_t> details;  ///< by run: word of the first point's details
        std::span<const VkDescriptorSet> sets;   ///< by run, then one of no words
        VkBuffer words = VK_NULL_HANDLE;         ///< of points, as the rounds left them
        VkBuffer records_buffer = VK_NULL_HANDLE;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item);

    [[nodiscard]] std::string print(GraphFormat format) const;

private:
    enum class Step : std::uint32_t { count, place, write };

    void dispatch_runs(VkCommandBuffer commands, Step step) const;
    void dispatch_place(VkCommandBuffer commands) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    gpu::Owned<VkPipeline> pipeline_;
    graph::Graph graph_;
    graph::Handle words_;
    graph::Handle tables_;
    graph::Handle blocks_;
    graph::Handle records_;
    std::unique_ptr<graph::Executor> executor_;
    Item item_;
};

}  // namespace nearfield::passes
