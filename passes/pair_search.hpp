#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <engine/plan/pair_question.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/search_shaders.hpp>

#include <shaders/pairs.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace nearfield::passes {

/// The passes that search all pairs of a world's instances, or the pairs that a batch gives, for
/// what is asked about them. One graph searches a part of them, and follows itself for each of
/// these parts, which take turns with the same scratch memory: it finds the directions of the
/// pairs, or takes those that are given; then come items, edges and points, each followed by a scan
/// that counts what they leave to the next, and a summary per pair, or a test whether the two
/// shapes meet; last, the points for the host, and the rows of those pairs that have an answer. To
/// find the pairs, each instance's are counted and listed; another graph, before all parts, makes
/// the boxes for that. The number of dispatches depends neither on the number of instances nor on
/// that of the pairs of a part. The commands need nothing from the CPU, so that they can be
/// submitted again and again.
class PairSearch {
public:
    /// The shaders must stay. `finding`: null where the pairs are given.
    PairSearch(const gpu::Device& device, const ComputeLayout& layout, const SearchShaders* shaders,
               const FoundPairShaders* finding, const plan::PairSearchKind& kind);

    /// The descriptor sets of one search: for the passes about instances or given pairs, those
    /// about points, and those about the answers of pairs.
    enum Set : std::uint8_t { of_instances, of_points, of_rows };
    static constexpr std::size_t set_count = 3;

    /// What the search of one part is recorded from. Its push constants name the part.
    struct Item {
        std::array<VkDescriptorSet, set_count> sets{};
        VkBuffer shapes = VK_NULL_HANDLE;
        VkBuffer instances = VK_NULL_HANDLE;  ///< or the given pairs
        VkBuffer scratch = VK_NULL_HANDLE;
        VkBuffer arguments = VK_NULL_HANDLE;
        VkBuffer records = VK_NULL_HANDLE;
        VkBuffer rows = VK_NULL_HANDLE;
        VkBuffer counts = VK_NULL_HANDLE;
        plan::SearchPush push{};  ///< without stage, capacities and flags
        /// How many elements of each stage there is room for.
        std::array<std::uint32_t, plan::stages_of_pairs> capacities{};
    };
    /// Once, before the parts, if the pairs are found. The item is that of any part.
    void record_boxes(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                      const Item& item) const;
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    static constexpr std::uint32_t passes_of_boxes = 2;
    static constexpr std::uint32_t max_passes_of_part = 14;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return (boxes_ ? boxes_->graph.print(format, "boxes of pairs") : "") +
               graph_.print(format, title);
    }

private:
    /// One thread per element that a stage has counted, or, without a stage, per instance.
    static constexpr std::uint32_t no_stage = UINT32_MAX;

    void declare_boxes();
    void declare_found_pairs();
    void declare_given_pairs();
    void declare_edges();
    void declare_points(const plan::PairSearchKind& kind);
    void declare_rows();
    void add(const char* name, const ComputeShader& shader, Set set,
             std::uint32_t threads_of = no_stage);
    void add_scan(const char* name, std::uint32_t stage);
    void add_packing();
    void add_answers(const char* name, const ComputeShader& shader);
    void dispatch(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
                  std::uint32_t threads_of, std::uint32_t stage) const;
    void push(VkCommandBuffer commands, const Item& item, const ComputeShader& shader,
              std::uint32_t first, std::uint32_t stage) const;

    struct Boxes {
        graph::RecordedGraph<Item> graph;
        graph::Handle input;
        graph::Handle instances;
        graph::Handle scratch;
    };

    const SearchShaders* shaders_;
    const FoundPairShaders* finding_;
    std::optional<ComputeShader> given_;  // where the pairs are
    std::uint32_t flags_;                 // of the push constants
    std::optional<Boxes> boxes_;          // where the pairs are found
    graph::RecordedGraph<Item> graph_;    // of a part
    graph::Handle input_;
    graph::Handle instances_;
    graph::Handle scratch_;
    graph::Handle arguments_;
    graph::ExternalAccess found_;  // before, of what the host reads
    graph::Handle records_;        // none where the host reads none
    graph::Handle row_buffer_;
    graph::Handle counts_;
};

}  // namespace nearfield::passes
