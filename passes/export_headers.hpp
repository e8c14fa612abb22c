#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/compute_shader.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace nearfield::passes {

/// The last pass of a batch with resident outputs: the header of each (ResidentHeaderData), in a
/// separate graph (see ExportField).
class ExportHeaders {
public:
    ExportHeaders(const gpu::Device& device, const ComputeLayout& layout);

    struct Item {
        std::span<const plan::ExportHeaderPush> headers;
        std::span<const VkDescriptorSet> sets;  ///< by header
        VkBuffer buffer = VK_NULL_HANDLE;       ///< of headers, and of most summaries
        /// In which the host uses buffers of its own after the batch: they wait for this pass,
        /// which reads the summaries there.
        VkPipelineStageFlags readers = 0;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    void dispatch(VkCommandBuffer commands, const Item& item) const;

    ComputeShader shader_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle headers_;
};

}  // namespace nearfield::passes
