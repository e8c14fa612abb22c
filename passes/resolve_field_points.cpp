#include <passes/resolve_field_points.hpp>

#include <shaders/resolve_field_points_comp.hpp>

#include <functional>

namespace nearfield::passes {

ResolveFieldPoints::ResolveFieldPoints(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::resolve_field_points_comp,
              "nearfield resolve field points") {}

graph::Handle ResolveFieldPoints::declare(TileGraph& graph, graph::Handle input,
                                          const FieldImages& images, graph::Handle field) const {
    return images.add_pass(graph, "resolve field points", input, field,
                           std::bind_front(&ResolveFieldPoints::record, this));
}

void ResolveFieldPoints::record(VkCommandBuffer commands, const RecordContext& context) const {
    shader_.bind(commands);
    for (const plan::FieldPointRun& run : context.batch.field_point_runs) {
        shader_.bind_set(commands, context.sets.field_by(run.sign));
        shader_.dispatch_elements<plan::ResolveFieldPointsPush>(
            commands, run.first, run.first + run.count, sign_mask(run.sign), run.first_word,
            run.first, run.parts.words_per_point, run.parts.cells_per_point);
    }
}

}  // namespace nearfield::passes
