#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/recorded_graph.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/compute_shader.hpp>

#include <span>
#include <string>

namespace nearfield::passes {

/// The last pass of a resident field: copies the resolved cells to images for the host's shaders.
/// It is a separate graph because the images belong to the batch and not to the compiled graph of a
/// tile batch. The graph leaves the images in the layout in which the host's shaders read them, or
/// in the one that the host asked for where they are its own.
class ExportField {
public:
    ExportField(const gpu::Device& device, const ComputeLayout& layout);

    /// The input of one field's pass.
    struct Item {
        const plan::FieldOutputs* field = nullptr;
        std::span<const plan::FieldPartOutput> parts;
        std::span<const VkDescriptorSet> sets;  ///< by part
        VkBuffer words = VK_NULL_HANDLE;        ///< of fields, as written by the tile batches
        graph::ImportedImage signed_distance;
        graph::ImportedImage feature;
    };
    void record(VkCommandBuffer commands, gpu::Timestamps& timestamps, const Item& item) const;

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    void dispatch(VkCommandBuffer commands, const Item& item) const;

    ComputeShader shader_;
    graph::RecordedGraph<Item> graph_;
    graph::Handle words_;
    graph::Handle signed_distance_;
    graph::Handle feature_;
};

}  // namespace nearfield::passes
