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

/// The last passes of resident intersection samples: box, count, place, write, in a separate graph
/// (see ExportField).
class ExportSamples {
public:
    ExportSamples(const gpu::Device& device, const ComputeLayout& layout);

    /// The input of one query's passes.
    struct Item {
        const plan::SamplesOutput* samples = nullptr;
        std::span<const plan::SampleRunOutput> runs;
        std::span<const plan::SampleTileData> tiles;  ///< of all queries
        /// Two per run: one whose words are the summaries, one whose words are the hits of the
        /// cells; then one without either.
        std::span<const VkDescriptorSet> sets;
        VkBuffer summaries = VK_NULL_HANDLE;  ///< as written by the tile batches
        VkBuffer blocks = VK_NULL_HANDLE;
        graph::ImportedBuffer output;  ///< of summary and samples
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    void dispatch_count(VkCommandBuffer commands, const Item& item) const;
    void dispatch_place(VkCommandBuffer commands, const Item& item) const;
    void dispatch_rows(VkCommandBuffer commands, const Item& item, std::uint32_t step) const;
    /// Dispatches `threads` threads. `table`, `first_tile`, `tile_count`: as in the shader.
    void dispatch(VkCommandBuffer commands, const Item& item, std::uint32_t step,
                  std::uint32_t table, std::uint32_t first_tile, std::uint32_t tile_count,
                  std::uint32_t threads) const;

    ComputeShader shader_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle summaries_;
    graph::Handle hits_;
    graph::Handle tables_;
    graph::Handle blocks_;
    graph::Handle samples_;
};

}  // namespace nearfield::passes
