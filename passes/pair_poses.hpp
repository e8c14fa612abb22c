#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_shader.hpp>

#include <shaders/push.h>

#include <cstdint>
#include <string>

namespace nearfield::passes {

/// The passes that take the poses of a world's instances from a buffer of the host's, in a separate
/// graph; PairSearch follows them in the same commands.
class PairPoses {
public:
    PairPoses(const gpu::Device& device, const ComputeLayout& layout);

    /// What it is recorded from.
    struct Item {
        VkDescriptorSet set = VK_NULL_HANDLE;
        graph::ImportedBuffer poses;  ///< with the host's uses of it
        VkBuffer shapes = VK_NULL_HANDLE;
        VkBuffer instances = VK_NULL_HANDLE;
        VkBuffer taken = VK_NULL_HANDLE;  ///< the poses, for the CPU
        plan::PosePush push{};            ///< without `first`
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

    static constexpr std::uint32_t max_passes = 2;

private:
    const gpu::Functions* functions_;
    ComputeShader shader_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle poses_;
    graph::Handle shapes_;
    graph::Handle instances_;
    graph::Handle taken_;
};

}  // namespace nearfield::passes
