#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/render/graph_key.hpp>
#include <engine/render/pipeline_set.hpp>
#include <nearfield/diagnostics.hpp>
#include <passes/compute_layout.hpp>
#include <passes/fields.hpp>
#include <passes/record_context.hpp>
#include <passes/resolve_field.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace nearfield::render {

/// The baked render graph for one GraphKey and one size of atlas.
class CompiledGraph {
public:
    CompiledGraph(const gpu::Device& device, const PipelineSet& passes, GraphKey needs,
                  VkExtent2D extent);

    [[nodiscard]] GraphKey needs() const { return needs_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }

    /// The buffers behind the graph's handles; null for handles that the graph does not have.
    struct Buffers {
        VkBuffer mesh = VK_NULL_HANDLE;
        VkBuffer input = VK_NULL_HANDLE;    ///< of compute passes
        VkBuffer scratch = VK_NULL_HANDLE;  ///< of the compute technique
        VkBuffer shapes = VK_NULL_HANDLE;   ///< of the compute technique: shapes in tiles
        VkBuffer crowd = VK_NULL_HANDLE;
        VkBuffer long_searches = VK_NULL_HANDLE;
        VkBuffer words = VK_NULL_HANDLE;      ///< of points and fields
        VkBuffer hits = VK_NULL_HANDLE;       ///< of intersections, where they are kept
        VkBuffer read_back = VK_NULL_HANDLE;  ///< of summaries and samples
    };
    void set_buffers(const Buffers& buffers);
    /// Points the images of descriptor sets to this graph's images.
    void bind_images(const passes::ComputeLayout& layout, const passes::TileBatchSets& sets) const;

    void execute(VkCommandBuffer commands, gpu::Timestamps& timestamps,
                 const passes::RecordContext& context) const {
        graph_.execute(commands, timestamps, context);
    }

    [[nodiscard]] std::string print(GraphFormat format, const char* title) const {
        return graph_.print(format, title);
    }

private:
    void declare_drawn(const RasterPipelines& passes);
    void declare_compute(const PipelineSet& passes);
    void declare_images(const RasterPipelines& passes);
    void declare_field(const RasterPipelines& passes);
    /// The passes over masks, and of fields at cells; returns what these wrote.
    passes::Fields::Output declare_masked(const PipelineSet& passes, passes::Fields::Output output);
    passes::Fields::Output declare_cells(const passes::Fields& fields, graph::Handle scratch,
                                         passes::Fields::Output output);

    GraphKey needs_;
    VkExtent2D extent_;
    passes::TileGraph graph_;
    graph::Handle mesh_;
    graph::Handle input_;
    graph::Handle scratch_;
    graph::Handle shapes_;
    graph::Handle crowd_;
    graph::Handle long_searches_;
    graph::Handle results_;
    graph::Handle field_;
    graph::Handle samples_;
    graph::Handle kept_hits_;
    passes::FieldImages images_;
    graph::Handle gradients_;
    std::array<graph::Handle, intersection_strategies> hits_;
};

}  // namespace nearfield::render
