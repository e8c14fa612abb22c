#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <engine/gpu/pipeline.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/graph/recorded_graph.hpp>

#include <shaders/layout.h>
#include <shaders/push.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>

namespace nearfield::passes {

/// Those of the largest push constants.
inline constexpr std::uint32_t max_push_bytes = sizeof(shaders::SearchPush);

/// The parts in which passes bind the samples of intersections.
namespace sample_parts {
inline constexpr std::uint32_t summaries = 0;  ///< by tile
inline constexpr std::uint32_t samples = 1;    ///< their number and list
}  // namespace sample_parts

/// A compute shader of the layout that all share: how it is bound and dispatched.
class ComputeShader {
public:
    ComputeShader(const gpu::Device& device, const graph::ComputeLayout& layout, gpu::Spirv code,
                  const char* name);

    void bind(VkCommandBuffer commands) const;
    void bind_set(VkCommandBuffer commands, VkDescriptorSet set) const;
    void bind(VkCommandBuffer commands, VkDescriptorSet set) const;

    /// Sets the push constants, a structure of shaders/push.h.
    template <class Push>
    void push(VkCommandBuffer commands, const Push& push) const {
        static_assert(sizeof(Push) <= max_push_bytes);
        PushBytes bytes{};
        std::memcpy(bytes.data(), &push, sizeof(Push));
        push_all(commands, bytes);
    }

    /// Dispatches one thread per element for the elements from `begin` to `end`, in as many
    /// dispatches as the device's limits require. The push constants of each, a structure of
    /// shaders/push.h, are its first element, `end`, and `words`.
    template <class Push, class... Words>
    void dispatch_elements(VkCommandBuffer commands, std::uint32_t begin, std::uint32_t end,
                           Words... words) const {
        dispatch_in_parts(commands, begin, end, Push{begin, end, words...});
    }
    /// The same with push constants of the caller, without `first`.
    template <class Push>
    void dispatch_in_parts(VkCommandBuffer commands, std::uint32_t begin, std::uint32_t end,
                           Push constants) const {
        constexpr std::uint64_t most = std::uint64_t{shaders::max_workgroups} * shaders::group_size;
        for (std::uint64_t first = begin; first < end; first += most) {
            constants.first = static_cast<std::uint32_t>(first);
            push(commands, constants);
            dispatch_threads(commands, std::min(end - first, most));
        }
    }
    /// The same with `count` workgroups.
    template <class Push>
    void dispatch_workgroups(VkCommandBuffer commands, std::uint32_t count, Push constants) const {
        for (std::uint64_t first = 0; first < count; first += shaders::max_workgroups) {
            constants.first = static_cast<std::uint32_t>(first);
            push(commands, constants);
            dispatch(commands, static_cast<std::uint32_t>(std::min<std::uint64_t>(
                                   count - first, shaders::max_workgroups)));
        }
    }
    /// Dispatches one thread per cell of a rectangle, in workgroups of field_group_side squared.
    void dispatch_cells(VkCommandBuffer commands, std::uint32_t width, std::uint32_t height) const;
    /// Dispatches `count` threads in a single dispatch.
    void dispatch_threads(VkCommandBuffer commands, std::uint64_t count) const;
    void dispatch(VkCommandBuffer commands, std::uint32_t groups) const;
    void dispatch_indirect(VkCommandBuffer commands, VkBuffer arguments, VkDeviceSize offset) const;

private:
    /// The whole range of the layout that all share: layers warn of bytes that were never set.
    using PushBytes = std::array<std::byte, max_push_bytes>;
    void push_all(VkCommandBuffer commands, const PushBytes& bytes) const;

    const gpu::Functions* functions_;
    VkPipelineLayout layout_;
    gpu::Owned<VkPipeline> pipeline_;
};

/// What passes do with most buffers.
inline constexpr graph::Access read = graph::Access::storage_read_in_compute;
inline constexpr graph::Access write = graph::Access::storage_write_in_compute;

/// Adds a pass of one shader, which has to stay: what it uses and at which bindings it finds it,
/// and `record(shader, commands, input)`, which dispatches it. The shader and the pass's first
/// descriptor set are bound already.
template <class Input, class Record>
void add_pass(graph::RecordedGraph<Input>& graph, std::string name, const ComputeShader& shader,
              std::span<const graph::Bound> bound, Record record) {
    graph.add_pass(
        std::move(name), graph::PassKind::compute,
        [&](graph::PassBuilder& pass) { pass.use(bound); },
        [&shader, record = std::move(record)](const graph::PassCommands& commands,
                                              const Input& input) {
            shader.bind(commands, commands.set());
            record(shader, commands, input);
        });
}
template <class Input, class Record>
void add_pass(graph::RecordedGraph<Input>& graph, std::string name, const ComputeShader& shader,
              std::initializer_list<graph::Bound> bound, Record record) {
    add_pass(graph, std::move(name), shader, std::span(bound.begin(), bound.size()),
             std::move(record));
}

}  // namespace nearfield::passes
