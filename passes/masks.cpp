#include <passes/masks.hpp>

#include <shaders/collect_masks_comp.hpp>
#include <shaders/mask_edges_comp.hpp>
#include <shaders/mask_polygons_comp.hpp>
#include <shaders/mask_rows_comp.hpp>

#include <functional>

namespace nearfield::passes {

using graph::Access;

Masks::Masks(const gpu::Device& device, const ComputeLayout& layout)
    : device_(&device),
      edges_(device, layout, shaders::mask_edges_comp, "nearfield mask edges"),
      rows_(device, layout, shaders::mask_rows_comp, "nearfield mask rows"),
      polygons_(device, layout, shaders::mask_polygons_comp, "nearfield mask polygons"),
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
    fill(work.mask_words, work.run_words, UINT32_MAX);
    if (!work.fields.tiles.empty()) {
        fill(work.field_lists().crowd - std::uint64_t{1}, 1, 0);
    }
}

graph::Handle Masks::declare_marks(TileGraph& graph, graph::Handle input,
                                   graph::Handle scratch) const {
    return graph.add_compute_pass("mark edges", {{input, Access::storage_read_in_compute}}, scratch,
                                  std::bind_front(&Masks::record_edges, this));
}

graph::Handle Masks::declare_fill(TileGraph& graph, graph::Handle input,
                                  graph::Handle scratch) const {
    return graph.add_compute_pass("fill rows", {{input, Access::storage_read_in_compute}}, scratch,
                                  std::bind_front(&Masks::record_rows, this));
}

void Masks::record_edges(VkCommandBuffer commands, const RecordContext& context) const {
    const auto ranges = context.batch.compute.ranges();
    edges_.bind(commands, context.sets.masks);
    edges_.dispatch_elements<plan::MaskEdgesPush>(commands, 0, ranges.edges.count,
                                                  ranges.edges.first_word, ranges.masks.first_word,
                                                  context.subpixel_bits);
}

void Masks::record_rows(VkCommandBuffer commands, const RecordContext& context) const {
    const auto ranges = context.batch.compute.ranges();
    rows_.bind(commands, context.sets.masks);
    rows_.dispatch_elements<plan::MaskRowsPush>(commands, 0, ranges.rows.count,
                                                ranges.rows.first_word);
}

graph::Handle Masks::declare_boundaries(TileGraph& graph, graph::Handle input,
                                        graph::Handle scratch, bool of_a) const {
    return graph.add_compute_pass(
        of_a ? "boundaries of A" : "boundaries of B", {{input, Access::storage_read_in_compute}},
        scratch, [this, of_a](VkCommandBuffer commands, const RecordContext& context) {
            record_polygons(commands, context, of_a);
        });
}

void Masks::record_polygons(VkCommandBuffer commands, const RecordContext& context,
                            bool of_a) const {
    const plan::ComputeWork& work = context.batch.compute;
    const auto ranges = work.ranges();
    const plan::WorkRange& polygons = of_a ? ranges.polygons_a : ranges.polygons_b;
    polygons_.bind(commands, context.sets.masks);
    polygons_.dispatch_elements<plan::MaskPolygonsPush>(
        commands, 0, polygons.count, polygons.first_word, ranges.masks.first_word,
        ranges.overlaps.first_word, static_cast<std::uint32_t>(work.mask_words),
        context.subpixel_bits | (of_a ? plan::polygons_of_a : 0U));
}

graph::Handle Masks::declare_collect(TileGraph& graph, graph::Handle input, graph::Handle scratch,
                                     graph::Handle samples) const {
    return graph.add_compute_pass(
        "collect masks",
        {{input, Access::storage_read_in_compute}, {scratch, Access::storage_read_in_compute}},
        samples, std::bind_front(&Masks::record_collect, this));
}

void Masks::record_collect(VkCommandBuffer commands, const RecordContext& context) const {
    const plan::ComputeWork& work = context.batch.compute;
    const auto ranges = work.ranges();
    collect_.bind(commands, context.sets.masks);
    collect_.dispatch_elements<plan::CollectMasksPush>(
        commands, 0, ranges.overlap_rows.count, ranges.overlap_rows.first_word,
        ranges.masks.first_word, ranges.overlaps.first_word,
        static_cast<std::uint32_t>(work.mask_words), context.sample_capacity);
}

}  // namespace nearfield::passes
