#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <engine/plan/world_question.hpp>
#include <passes/search_shaders.hpp>

#include <shaders/world_queries.h>

#include <cstdint>
#include <string>

namespace nearfield::passes {

/// The passes that answer many questions of one kind about a world's instances, in a separate
/// graph: boxes of the instances and the levels above them, as PairSearch has them; a walk over
/// these for each question; and a copy of the answers for the CPU.
class WorldQueries {
public:
    /// The shaders of the instances must stay.
    WorldQueries(const gpu::Device& device, const ComputeLayout& layout,
                 const InstanceShaders* instance_shaders, plan::WorldQuestion question);

    /// What they are recorded from.
    struct Item {
        VkDescriptorSet set = VK_NULL_HANDLE;
        VkBuffer shapes = VK_NULL_HANDLE;
        VkBuffer instances = VK_NULL_HANDLE;
        VkBuffer questions = VK_NULL_HANDLE;
        VkBuffer scratch = VK_NULL_HANDLE;
        VkBuffer answers = VK_NULL_HANDLE;
        VkBufferCopy copy{};          ///< of the answers
        plan::WorldQueryPush push{};  ///< without `first`
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    static constexpr std::uint32_t max_passes = 4;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    const gpu::Functions* functions_;
    const InstanceShaders* instance_shaders_;
    ComputeShader shader_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle shapes_;
    graph::Handle instances_;
    graph::Handle questions_;
    graph::Handle scratch_;
    graph::Handle answers_;
};

}  // namespace nearfield::passes
