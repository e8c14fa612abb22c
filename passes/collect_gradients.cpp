#include <passes/collect_gradients.hpp>

#include <shaders/collect_gradients_comp.hpp>

#include <functional>

namespace nearfield::passes {

CollectGradients::CollectGradients(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::collect_gradients_comp, "nearfield collect gradients") {}

graph::Handle CollectGradients::declare(TileGraph& graph, graph::Handle input,
                                        graph::Handle gradients, graph::Handle field) const {
    return graph.add_compute_pass("collect gradients",
                                  {{input, graph::Access::storage_read_in_compute},
                                   {gradients, graph::Access::sampled_in_compute}},
                                  field, std::bind_front(&CollectGradients::record, this));
}

void CollectGradients::record(VkCommandBuffer commands, const RecordContext& context) const {
    shader_.bind(commands, context.sets.gradients);
    for (const plan::FieldTile& field : context.batch.field_tiles) {
        if (field.first_gradient != plan::not_asked) {
            const plan::TileData& tile = context.batch.tiles[field.tile];
            shader_.dispatch_elements<plan::CollectGradientsPush>(
                commands, 0, tile.width * tile.height, field.first_gradient, 0U, 0U, field.tile);
        }
    }
    for (const plan::FieldPointRun& run : context.batch.field_point_runs) {
        if (run.parts.blended) {
            shader_.dispatch_elements<plan::CollectGradientsPush>(
                commands, 4 * run.first, 4 * (run.first + run.count), run.first_word, run.first,
                run.parts.words_per_point, 0U);
        }
    }
}

}  // namespace nearfield::passes
