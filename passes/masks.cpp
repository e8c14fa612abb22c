#include <passes/masks.hpp>

#include <shaders/collect_masks_comp.hpp>
#include <shaders/mask_shapes_comp.hpp>

namespace nearfield::passes {

using graph::Access;

namespace {

/// The first unit of the shapes in masks, behind the shapes, and the tiles and points of fields.
std::uint32_t first_mask_shape(const RecordContext& context) {
    const device_input::FieldWork& fields = context.batch.work.fields;
    return context.shape_units +
           static_cast<std::uint32_t>(fields.tiles.size() * shaders::units_of_field_tile +
                                      fields.points.size());
}

}  // namespace

Masks::Masks(const gpu::Device& device, const graph::ComputeLayout& layout)
    : device_(&device),
      shapes_(device, layout, shaders::mask_shapes_comp, "nearfield mask shapes"),
      collect_(device, layout, shaders::collect_masks_comp, "nearfield collect masks") {}

// The scratch memory belongs to the tile batch, whose former use has been waited for.
void Masks::declare_shapes(TileGraph& graph, graph::Handle shapes, graph::Handle& scratch) const {
    graph.add_pass(
        "clear masks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) { scratch = pass.write(scratch, Access::transfer_write); },
        [this, scratch](const graph::PassCommands& commands, const RecordContext& context) {
            const device_input::ComputeWork& work = context.batch.work;
            const auto fill = [&](std::uint64_t first, std::uint64_t words, std::uint32_t value) {
                if (words > 0) {
                    device_->functions().vkCmdFillBuffer(commands, commands.part(scratch).buffer,
                                                         first * sizeof(value),
                                                         words * sizeof(value), value);
                }
            };
            fill(0, work.mask_words, 0);
            fill(work.mask_words, work.edge_words, UINT32_MAX);
            if (!work.fields.tiles.empty()) {
                fill(work.field_lists().crowd - std::uint64_t{1}, 1, 0);
            }
        });
    add_pass(
        graph, "mask shapes", shapes_, {{0, shapes}, {1, scratch, write}},
        [](const ComputeShader& shader, VkCommandBuffer commands, const RecordContext& context) {
            const device_input::ComputeWork& work = context.batch.work;
            shader.dispatch_elements<shaders::MaskShapesPush>(
                commands, 0, work.mask_threads, first_mask_shape(context),
                static_cast<std::uint32_t>(work.mask_shapes.size()),
                static_cast<std::uint32_t>(work.mask_words));
        });
}

void Masks::declare_collect(TileGraph& graph, graph::Handle shapes, graph::Handle& scratch,
                            graph::Handle samples) const {
    add_pass(
        graph, "collect masks", collect_,
        {{0, shapes},
         {1, scratch, write},
         {2, samples, write, sample_parts::summaries},
         {3, samples, write, sample_parts::samples}},
        [](const ComputeShader& shader, VkCommandBuffer commands, const RecordContext& context) {
            const device_input::ComputeWork& work = context.batch.work;
            shader.dispatch_elements<shaders::CollectMasksPush>(
                commands, 0, work.overlap_rows,
                first_mask_shape(context) + static_cast<std::uint32_t>(work.mask_shapes.size()) *
                                                shaders::units_of_mask_shape,
                static_cast<std::uint32_t>(work.overlaps.size()),
                static_cast<std::uint32_t>(work.mask_words), context.sample_capacity);
        });
}

}  // namespace nearfield::passes
