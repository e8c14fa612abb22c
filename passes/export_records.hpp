#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/compute_shader.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace nearfield::passes {

/// The last passes of resident records: count, place, write, in a separate graph (see ExportField).
class ExportRecords {
public:
    ExportRecords(const gpu::Device& device, const ComputeLayout& layout);

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
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    void dispatch_runs(VkCommandBuffer commands, const Item& item, std::uint32_t step) const;
    void dispatch_place(VkCommandBuffer commands, const Item& item) const;

    ComputeShader shader_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle words_;
    graph::Handle tables_;
    graph::Handle blocks_;
    graph::Handle records_;
};

}  // namespace nearfield::passes
