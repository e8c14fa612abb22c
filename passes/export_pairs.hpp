#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_shader.hpp>
#include <passes/pair_search.hpp>

#include <shaders/push.h>

#include <array>
#include <cstdint>
#include <string>

namespace nearfield::passes {

/// The passes that write what stays on the device of the pairs of a world, in a separate graph that
/// follows PairSearch in the same commands: the frame of each direction, rows, records and headers.
class ExportPairs {
public:
    ExportPairs(const gpu::Device& device, const ComputeLayout& layout);

    /// The descriptor sets, beside that of the search's passes about instances.
    enum Set : std::uint8_t { of_rows, of_records, of_headers };
    static constexpr std::size_t set_count = 3;

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

    static constexpr std::uint32_t max_passes = 4;

private:
    void declare_frames();
    void declare_outputs();
    void add_output(const char* name, const ComputeShader& shader, Set set, std::uint32_t stage,
                    graph::Handle input, graph::Handle& output);

    ComputeShader frames_;
    ComputeShader rows_;
    ComputeShader records_;
    ComputeShader headers_;
    graph::RecordedGraph<Item> graph_;
    // Of the search:
    graph::Handle shapes_;
    graph::Handle instances_;
    graph::Handle scratch_;
    graph::Handle arguments_;
    graph::Handle found_;
    graph::Handle found_rows_;
    // What stays:
    graph::Handle pair_output_;
    graph::Handle record_output_;
    graph::Handle header_output_;
};

}  // namespace nearfield::passes
