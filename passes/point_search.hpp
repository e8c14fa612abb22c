#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/compute_shader.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace nearfield::passes {

/// Where the arrays of a search lie in its scratch memory, in words or units of four words, and how
/// many elements they have room for.
struct SearchLayout {
    std::uint32_t item_blocks = 0, edge_blocks = 0, point_blocks = 0, item_words = 0;  // words
    std::uint32_t edge_units = 0, point_units = 0;                                     // units
    std::uint64_t units = 0;  ///< of the whole
    /// Of edges, points, and points that were found.
    std::array<std::uint32_t, plan::stages> capacities{};
};

/// The passes that search for boundary points (plan::PointSearch), in a separate graph: items,
/// edges, points, each followed by a scan that counts what they leave to the next; at last, the
/// points that were found are packed. The number of dispatches does not depend on that of queries.
class PointSearch {
public:
    PointSearch(const gpu::Device& device, const ComputeLayout& layout);

    /// What one search is recorded from.
    struct Item {
        VkDescriptorSet set = VK_NULL_HANDLE;
        VkBuffer input = VK_NULL_HANDLE;
        VkBuffer scratch = VK_NULL_HANDLE;
        VkBuffer records = VK_NULL_HANDLE;
        VkBuffer arguments = VK_NULL_HANDLE;
        SearchLayout layout;
        std::uint32_t items = 0;
        std::uint32_t first_direction = 0;  ///< unit of the input
        std::uint32_t directions = 0;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    static constexpr std::uint32_t pass_count = 7;

    [[nodiscard]] std::string print(GraphFormat format) const { return graph_.print(format); }

private:
    void declare();
    static void push(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                     std::uint32_t first, std::uint32_t stage);
    void dispatch_items(VkCommandBuffer commands, const Item& item) const;
    void dispatch_scan(VkCommandBuffer commands, const Item& item, std::uint32_t stage) const;
    void dispatch(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                  std::uint32_t arguments) const;

    ComputeShader items_;
    ComputeShader scan_;
    ComputeShader edges_;
    ComputeShader points_;
    ComputeShader pack_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle input_;
    graph::Handle scratch_;
    graph::Handle arguments_;
    graph::Handle records_;
};

}  // namespace nearfield::passes
