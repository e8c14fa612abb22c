#pragma once

#include <engine/device_input/pair_question.hpp>
#include <engine/gpu/device.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_shader.hpp>

#include <shaders/pairs.h>
#include <shaders/push.h>
#include <shaders/search.h>
#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>

namespace nearfield::passes {

/// Bytes of the arguments of one stage's dispatch.
inline constexpr VkDeviceSize search_argument_bytes =
    shaders::words_of_arguments * sizeof(std::uint32_t);

/// The shaders that make the boxes of a world's instances, and the levels above them.
struct InstanceShaders {
    InstanceShaders(const gpu::Device& device, const graph::ComputeLayout& layout);

    ComputeShader boxes;
    ComputeShader levels;
};

/// The shaders of all searches between pairs (PairSearch), given or found.
struct SearchShaders {
    SearchShaders(const gpu::Device& device, const graph::ComputeLayout& layout);

    ComputeShader items;
    ComputeShader spread;
    ComputeShader edges;
    ComputeShader points;
    ComputeShader summaries;
    ComputeShader pack;
    ComputeShader rows;
};

/// Those that find the pairs of a world's instances, and what can be asked of these alone.
struct FoundPairShaders {
    /// `instance_shaders` have to stay.
    FoundPairShaders(const gpu::Device& device, const graph::ComputeLayout& layout,
                     const InstanceShaders* instance_shaders);

    const InstanceShaders& instances;
    ComputeShader counts;
    ComputeShader lists;
    ComputeShader directions;
    ComputeShader contacts;
    ComputeShader crossings;
    ComputeShader verdicts;
};

/// The passes that search all pairs of a world's instances, or the pairs that a batch gives, for
/// what is asked about them. One graph searches a part of them, and follows itself for each of
/// these parts, which take turns with the same scratch memory: it finds the directions of the
/// pairs, or takes those that are given; then come items, edges and points, each of which counts
/// what it leaves to the next, and a summary per pair, or a test whether the two shapes meet; last,
/// the points for the host, and the rows of those pairs that have an answer. To find the pairs,
/// each instance's are counted and listed; another graph, before all parts, makes the boxes for
/// that. The number of dispatches depends neither on the number of instances nor on that of the
/// pairs of a part. The commands need nothing from the CPU, so that they can be submitted again and
/// again.
class PairSearch {
public:
    /// The shaders must stay. `finding`: null where the pairs are given.
    PairSearch(const gpu::Device& device, const graph::ComputeLayout& layout,
               const SearchShaders* shaders, const FoundPairShaders* finding,
               const device_input::PairSearchKind& kind);
    PairSearch(const PairSearch&) = delete;
    PairSearch& operator=(const PairSearch&) = delete;

    /// What they are recorded from, beside the resources that they bind.
    struct Input {
        shaders::SearchPush push{};  ///< without stage, capacities and flags; names the part
        /// How many elements of each stage there is room for.
        std::array<std::uint32_t, shaders::stages_of_pairs> capacities{};
    };
    struct Passes {
        graph::RecordedGraph<Input> graph;
        graph::Handle shapes;
        graph::Handle instances;  ///< or the given pairs
        graph::Handle scratch;
        graph::Handle arguments;  ///< of a part, as are those that follow
        graph::Handle points;     ///< null where the host reads none
        graph::Handle rows;
        graph::Handle counts;
    };
    /// Once, before the parts, with the push constants of any part; null if the pairs are given.
    [[nodiscard]] const Passes* boxes() const { return boxes_ ? &*boxes_ : nullptr; }
    [[nodiscard]] const Passes& part() const { return part_; }

private:
    /// One thread per element that a stage has counted, or, without a stage, per instance.
    static constexpr std::uint32_t no_stage = UINT32_MAX;

    /// The versions of the buffers of a part between passes.
    struct Versions {
        graph::Handle shapes, instances, scratch, arguments, points, rows, counts;
    };

    void declare_boxes();
    void declare_found_pairs(Versions& at);
    void declare_given_pairs(Versions& at);
    void declare_edges(Versions& at);
    void declare_points(Versions& at, const device_input::PairSearchKind& kind);
    void declare_rows(Versions& at);
    /// Adds a pass of a part that writes into the scratch memory, with a thread per edge or point.
    void add(Versions& at, const char* name, const ComputeShader& shader, std::uint32_t threads_of);
    /// One that also says how much it leaves to a stage.
    void add_counting(Versions& at, const char* name, const ComputeShader& shader,
                      std::uint32_t threads_of, std::uint32_t stage);
    void add_answers(Versions& at, const char* name, const ComputeShader& shader);
    /// Adds any pass. `stage`: that the shader counts.
    void add(Passes& passes, const char* name, const ComputeShader& shader,
             std::initializer_list<graph::Bound> bound, std::uint32_t threads_of,
             std::uint32_t stage);
    [[nodiscard]] shaders::SearchPush push_of(const Input& input, std::uint32_t stage) const;

    const SearchShaders* shaders_;
    const FoundPairShaders* finding_;
    std::optional<ComputeShader> given_;  // where the pairs are
    std::uint32_t flags_;                 // of the push constants
    std::optional<Passes> boxes_;         // where the pairs are found
    Passes part_;
};

}  // namespace nearfield::passes
