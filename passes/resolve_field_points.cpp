#include <passes/resolve_field_points.hpp>

#include <shaders/resolve_field_points_comp.hpp>

#include <functional>

namespace nearfield::passes {

ResolveFieldPoints::ResolveFieldPoints(const gpu::Device& device, const ComputeLayout& layout)
    : shader_(device, layout, shaders::resolve_field_points_comp,
              "nearfield resolve field points") {}

graph::Handle ResolveFieldPoints::declare(TileGraph& graph, graph::Handle input,
                                          const FieldImages& images, graph::Handle field) const {
    graph.add_pass(
        "resolve field points", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(input, graph::Access::storage_read_in_compute);
            images.declare_reads(pass);
            field = pass.write(field, graph::Access::storage_write_in_compute);
        },
        std::bind_front(&ResolveFieldPoints::record, this));
    return field;
}

void ResolveFieldPoints::record(VkCommandBuffer commands, const RecordContext& context) const {
    shader_.bind(commands);
    for (const plan::FieldPointRun& run : context.batch->field_point_runs) {
        shader_.bind_set(commands, context.field_set(run.sign));
        shader_.dispatch_elements<plan::ResolveFieldPointsPush>(
            commands, run.first, run.first + run.count, sign_mask(run.sign), run.first_word,
            run.first, run.parts.words_per_point, run.parts.cells_per_point);
    }
}

}  // namespace nearfield::passes
