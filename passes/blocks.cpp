#include <passes/blocks.hpp>

#include <shaders/resolve_blocks_comp.hpp>
#include <shaders/resolve_features_comp.hpp>
#include <shaders/resolve_field_points_by_lists_comp.hpp>

#include <functional>
#include <utility>

namespace nearfield::passes {
namespace {

graph::Handle add_pass(TileGraph& graph, const char* name, graph::Handle input,
                       graph::Handle scratch, graph::Handle field, TileGraph::Record record) {
    return graph.add_compute_pass(name,
                                  {{input, graph::Access::storage_read_in_compute},
                                   {scratch, graph::Access::storage_read_in_compute}},
                                  field, std::move(record));
}

}  // namespace

Blocks::Blocks(const gpu::Device& device, const ComputeLayout& layout)
    : values_(device, layout, shaders::resolve_blocks_comp, "nearfield resolve blocks"),
      features_(device, layout, shaders::resolve_features_comp, "nearfield resolve features"),
      points_(device, layout, shaders::resolve_field_points_by_lists_comp,
              "nearfield resolve field points by lists") {}

graph::Handle Blocks::declare_values(TileGraph& graph, graph::Handle input, graph::Handle scratch,
                                     graph::Handle field) const {
    return add_pass(graph, "resolve blocks", input, scratch, field,
                    std::bind_front(&Blocks::record_values, this));
}

graph::Handle Blocks::declare_features(TileGraph& graph, graph::Handle input, graph::Handle scratch,
                                       graph::Handle field) const {
    return add_pass(graph, "resolve features", input, scratch, field,
                    std::bind_front(&Blocks::record_features, this));
}

graph::Handle Blocks::declare_points(TileGraph& graph, graph::Handle input, graph::Handle scratch,
                                     graph::Handle field) const {
    return add_pass(graph, "resolve field points by lists", input, scratch, field,
                    std::bind_front(&Blocks::record_points, this));
}

void Blocks::record_values(VkCommandBuffer commands, const RecordContext& context) const {
    const std::size_t blocks = context.batch.compute.blocks.size();
    values_.bind(commands, context.sets.blocks);
    values_.dispatch_elements<plan::ResolveBlocksPush>(
        commands, 0, static_cast<std::uint32_t>(blocks) * plan::threads_per_block);
}

void Blocks::record_features(VkCommandBuffer commands, const RecordContext& context) const {
    constexpr std::uint32_t cells = plan::block_side * plan::block_side;
    const std::size_t blocks = context.batch.compute.feature_blocks.size();
    features_.bind(commands, context.sets.feature_blocks);
    features_.dispatch_elements<plan::ResolveFeaturesPush>(
        commands, 0, static_cast<std::uint32_t>(blocks) * cells, context.batch.resident ? 1U : 0U);
}

void Blocks::record_points(VkCommandBuffer commands, const RecordContext& context) const {
    const plan::TileBatch& batch = context.batch;
    const auto points = static_cast<std::uint32_t>(batch.lists.geometry().size());
    points_.bind(commands, context.sets.feature_blocks);
    for (const plan::FieldPointRun& run : batch.field_point_runs) {
        points_.dispatch_elements<plan::ResolveFieldPointsByListsPush>(
            commands, run.first, run.first + run.count, points, run.first_word, run.first,
            run.parts.words_per_point, run.parts.cells_per_point);
    }
}

}  // namespace nearfield::passes
