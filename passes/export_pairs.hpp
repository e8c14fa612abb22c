#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_shader.hpp>
#include <passes/pair_search.hpp>

#include <shaders/push.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace nearfield::passes {

/// The passes that write what stays on the device of the pairs of a world, in a separate graph that
/// follows PairSearch in the same commands: rows and headers, and records.
class ExportPairs {
public:
    ExportPairs(const gpu::Device& device, const ComputeLayout& layout);

    /// The descriptor sets.
    enum Set : std::uint8_t { of_rows, of_records };
    static constexpr std::size_t set_count = 2;

    /// What it is recorded from.
    struct Item {
        const PairSearch::Item* search = nullptr;  ///< that was recorded before
        std::array<VkDescriptorSet, set_count> sets{};
        VkBuffer pairs = VK_NULL_HANDLE;
        VkBuffer records = VK_NULL_HANDLE;
        VkBuffer headers = VK_NULL_HANDLE;
        plan::vec2 origin;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

    static constexpr std::uint32_t max_passes = 2;

private:
    void declare_rows();
    void declare_records();

    ComputeShader rows_;
    ComputeShader records_;
    graph::RecordedGraph<Item> graph_;
    // Of the search:
    graph::Handle shapes_;
    graph::Handle instances_;
    graph::Handle scratch_;
    graph::Handle arguments_;
    graph::Handle found_rows_;
    // What stays:
    graph::Handle pair_output_;
    graph::Handle record_output_;
    graph::Handle header_output_;
};

}  // namespace nearfield::passes
