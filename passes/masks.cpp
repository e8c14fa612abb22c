#include <passes/masks.hpp>
#include <passes/search_shaders.hpp>

#include <shaders/collect_masks_comp.hpp>
#include <shaders/mask_rows_comp.hpp>
#include <shaders/mask_shapes_comp.hpp>

#include <functional>

namespace nearfield::passes {

using graph::Access;

Masks::Masks(const gpu::Device& device, const ComputeLayout& layout)
    : device_(&device),
      shapes_(device, layout, shaders::mask_shapes_comp, "nearfield mask shapes",
              search_constants(device)),
      rows_(device, layout, shaders::mask_rows_comp, "nearfield mask rows"),
      collect_(device, layout, shaders::collect_masks_comp, "nearfield collect masks") {}

graph::Handle Masks::declare_clear(TileGraph& graph, graph::Handle scratch) const {
    graph.add_pass(
        "clear masks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) { scratch = pass.write(scratch, Access::transfer_write); },
        std::bind_front(&Masks::record_clear, this));
    return scratch;
}

// The scratch memory belongs to the tile batch, whose former use has been waited for.
void Masks::record_clear(VkCommandBuffer commands, const RecordContext& context) const {
    const plan::ComputeWork& work = context.batch.compute;
    const auto fill = [&](std::uint64_t first, std::uint64_t words, std::uint32_t value) {
        if (words > 0) {
            device_->functions().vkCmdFillBuffer(commands, context.scratch, first * sizeof(value),
                                                 words * sizeof(value), value);
        }
    };
    fill(0, work.mask_words, 0);
    fill(work.mask_words, work.edge_words, UINT32_MAX);
    if (!work.fields.tiles.empty()) {
        fill(work.field_lists().crowd - std::uint64_t{1}, 1, 0);
    }
}

graph::Handle Masks::declare_shapes(TileGraph& graph, graph::Handle shapes,
                                    graph::Handle scratch) const {
    return graph.add_compute_pass("mask shapes", {{shapes, Access::storage_read_in_compute}},
                                  scratch, std::bind_front(&Masks::record_shapes, this));
}

void Masks::record_shapes(VkCommandBuffer commands, const RecordContext& context) const {
    const plan::ComputeWork& work = context.batch.compute;
    // Behind the shapes, and the tiles and points of fields.
    const std::size_t first = context.shape_units +
                              work.fields.tiles.size() * plan::units_of_field_tile +
                              work.fields.points.size();
    shapes_.bind(commands, context.sets.fields);
    shapes_.dispatch_elements<plan::MaskShapesPush>(
        commands, 0, work.mask_threads, static_cast<std::uint32_t>(first),
        static_cast<std::uint32_t>(work.mask_shapes.size()),
        static_cast<std::uint32_t>(work.mask_words));
}

graph::Handle Masks::declare_fill(TileGraph& graph, graph::Handle input,
                                  graph::Handle scratch) const {
    return graph.add_compute_pass("fill rows", {{input, Access::storage_read_in_compute}}, scratch,
                                  std::bind_front(&Masks::record_rows, this));
}

void Masks::record_rows(VkCommandBuffer commands, const RecordContext& context) const {
    const plan::ComputeWork& work = context.batch.compute;
    rows_.bind(commands, context.sets.masks);
    // Behind the overlaps.
    rows_.dispatch_elements<plan::MaskRowsPush>(
        commands, 0, static_cast<std::uint32_t>(work.field_rows.size()),
        static_cast<std::uint32_t>(work.overlaps.size()) * 4 * plan::units_of_overlap);
}

graph::Handle Masks::declare_collect(TileGraph& graph, Collected buffers) const {
    graph.add_pass(
        "collect masks", graph::PassKind::compute,
        [&](graph::PassBuilder& pass) {
            pass.read(buffers.input, Access::storage_read_in_compute);
            buffers.scratch = pass.write(buffers.scratch, Access::storage_write_in_compute);
            static_cast<void>(pass.write(buffers.samples, Access::storage_write_in_compute));
        },
        std::bind_front(&Masks::record_collect, this));
    return buffers.scratch;
}

void Masks::record_collect(VkCommandBuffer commands, const RecordContext& context) const {
    const plan::ComputeWork& work = context.batch.compute;
    collect_.bind(commands, context.sets.masks);
    collect_.dispatch_elements<plan::CollectMasksPush>(
        commands, 0, work.overlap_rows, static_cast<std::uint32_t>(work.overlaps.size()),
        static_cast<std::uint32_t>(work.mask_words), context.sample_capacity);
}

}  // namespace nearfield::passes
