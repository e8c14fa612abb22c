#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/execute.hpp>
#include <engine/graph/graph.hpp>

#include <memory>
#include <span>

namespace nearfield::passes {

/// Copies words of tile batches with resident outputs to the read-back buffer, in a separate graph
/// (see ExportField).
class CopyBack {
public:
    explicit CopyBack(const gpu::Device& device);
    CopyBack(const CopyBack&) = delete;
    CopyBack& operator=(const CopyBack&) = delete;

    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, VkBuffer words,
                VkBuffer read_back, std::span<const VkBufferCopy> ranges);

private:
    const gpu::Device* device_;
    graph::Graph graph_;
    graph::Handle words_;
    graph::Handle read_back_;
    std::unique_ptr<graph::Executor> executor_;
    VkBuffer from_ = VK_NULL_HANDLE;
    VkBuffer to_ = VK_NULL_HANDLE;
    std::span<const VkBufferCopy> ranges_;
};

}  // namespace nearfield::passes
