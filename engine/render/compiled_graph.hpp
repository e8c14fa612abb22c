#pragma once

#include <engine/gpu/device.hpp>
#include <engine/render/graph_key.hpp>
#include <engine/render/pipeline_set.hpp>
#include <passes/fields.hpp>
#include <passes/record_context.hpp>
#include <passes/resolve_field.hpp>

namespace nearfield::render {

/// The imported handles of a tile batch's graph, before any pass; null where its passes need none.
struct TileHandles {
    graph::Handle mesh;
    graph::Handle input;          ///< in the parts of passes::input_parts
    graph::Handle scratch;        ///< of the compute technique, as are the next three
    graph::Handle shapes;         ///< in tiles
    graph::Handle crowd;          ///< arguments of the dispatch for crowded blocks
    graph::Handle long_searches;  ///< in crowded blocks
    graph::Handle results;        ///< of points
    graph::Handle field;          ///< results of fields
    graph::Handle samples;        ///< in the parts of passes::sample_parts
};

/// The baked render graph for one GraphKey and one size of atlas.
class CompiledGraph {
public:
    CompiledGraph(const gpu::Device& device, const PipelineSet& passes, GraphKey needs,
                  VkExtent2D extent);

    [[nodiscard]] GraphKey needs() const { return needs_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    [[nodiscard]] const TileHandles& handles() const { return handles_; }
    [[nodiscard]] const passes::TileGraph& graph() const { return graph_; }

private:
    void declare_drawn(const RasterPipelines& passes);
    void declare_overlaps(const RasterPipelines& passes);
    void declare_compute(const PipelineSet& passes);
    [[nodiscard]] passes::FieldImages declare_images(const RasterPipelines& passes);
    void declare_field(const RasterPipelines& passes, passes::FieldImages images);
    /// The passes over masks, and of fields at cells, which write `output`.
    void declare_masked(const PipelineSet& passes, passes::Fields::Output& output);
    void declare_cells(const passes::Fields& fields, graph::Handle scratch,
                       passes::Fields::Output& output);

    GraphKey needs_;
    VkExtent2D extent_;
    passes::TileGraph graph_;
    TileHandles handles_;
};

}  // namespace nearfield::render
