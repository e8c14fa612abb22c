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

/// The last passes of intersections whose samples stay on the device: count, place, write, in a
/// graph to themselves (see HandOverField).
class HandOverSamples {
public:
    HandOverSamples(const gpu::Device& device, const ComputeLayout& layout);
    HandOverSamples(const HandOverSamples&) = delete;
    HandOverSamples& operator=(const HandOverSamples&) = delete;

    /// What a query's passes record from.
    struct Item {
        const plan::SamplesHandOver* samples = nullptr;
        std::span<const plan::SampleRunHandOver> runs;
        std::span<const plan::SampleTileData> tiles;  ///< of all queries
        /// By run two, of which the words are its summaries, and what was found in its cells; then
        /// one of neither.
        std::span<const VkDescriptorSet> sets;
        VkBuffer summaries = VK_NULL_HANDLE;  ///< as the rounds left them
        VkBuffer samples_buffer = VK_NULL_HANDLE;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item);

    [[nodiscard]] std::string print(GraphFormat format) const;

private:
    enum class Step : std::uint32_t { box, count, place, write };

    void dispatch_count(VkCommandBuffer commands) const;
    void dispatch_place(VkCommandBuffer commands) const;
    void dispatch_rows(VkCommandBuffer commands, Step step) const;
    void bind(VkCommandBuffer commands, VkDescriptorSet set) const;
    /// One thread each for `threads`. `table`, `first_tile`, `tile_count`: as in the shader.
    void dispatch(VkCommandBuffer commands, Step step, std::uint32_t table,
                  std::uint32_t first_tile, std::uint32_t tile_count, std::uint32_t threads) const;

    const gpu::Device* device_;
    VkPipelineLayout layout_;
    gpu::Owned<VkPipeline> pipeline_;
    graph::Graph graph_;
    graph::Handle summaries_;
    graph::Handle hits_;
    graph::Handle tables_;
    graph::Handle blocks_;
    graph::Handle samples_;
    std::unique_ptr<graph::Executor> executor_;
    Item item_;
};

}  // namespace nearfield::passes
