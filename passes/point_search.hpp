#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/search_shaders.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace nearfield::passes {

/// The passes that search for boundary points (plan::PointSearch), in a separate graph: items,
/// edges and points, each followed by a scan that counts what they leave to the next; at last, the
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
        plan::SearchPush push{};  ///< without stage and capacities
        /// How many elements of each stage there is room for.
        std::array<std::uint32_t, plan::stages> capacities{};
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    static constexpr std::uint32_t pass_count = 8;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    void declare();
    static void push(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                     std::uint32_t first, std::uint32_t stage);
    static void dispatch_items(VkCommandBuffer commands, const Item& item,
                               const ComputeShader& shader);
    void dispatch_scan(VkCommandBuffer commands, const Item& item, std::uint32_t stage) const;
    void dispatch(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                  std::uint32_t arguments) const;

    SearchShaders shaders_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle input_;
    graph::Handle scratch_;
    graph::Handle arguments_;
    graph::Handle records_;
};

}  // namespace nearfield::passes
