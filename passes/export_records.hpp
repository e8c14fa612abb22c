#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/graph.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/compute_layout.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace nearfield::passes {

/// The last passes of resident records: count, place, write, in a separate graph (see ExportField).
class ExportRecords {
public:
    ExportRecords(const gpu::Device& device, const ComputeLayout& layout);
    ExportRecords(const ExportRecords&) = delete;
    ExportRecords& operator=(const ExportRecords&) = delete;

    /// The input of one query's passes.
    struct Item {
        const plan::RecordsOutput* records = nullptr;
        std::span<const plan::PointRunOutput> runs;
        std::span<const std::uint32_t> details;  ///< by run: index of the first point's details
        std::span<const VkDescriptorSet> sets;   ///< by run, then one without words
        VkBuffer words = VK_NULL_HANDLE;         ///< of points, as written by the tile batches
        VkBuffer blocks = VK_NULL_HANDLE;
        graph::ImportedBuffer output;  ///< of summary and records
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
