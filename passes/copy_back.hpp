#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>

#include <span>

namespace nearfield::passes {

/// Copies words of tile batches with resident outputs to the read-back buffer, in a separate graph
/// (see ExportField).
class CopyBack {
public:
    explicit CopyBack(const gpu::Device& device);

    struct Item {
        VkBuffer words = VK_NULL_HANDLE;
        VkBuffer read_back = VK_NULL_HANDLE;
        std::span<const VkBufferCopy> ranges;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

private:
    graph::RecordedGraph<Item> graph_;
    graph::Handle words_;
    graph::Handle read_back_;
};

}  // namespace nearfield::passes
