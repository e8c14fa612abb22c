#include <engine/plan/compute_batch_builder.hpp>
#include <engine/plan/tile_batch.hpp>

namespace nearfield::plan {
namespace {

/// In place of the reach of a boundary.
constexpr double by_volume = -1.0;

/// Some drivers end the loops of threads that run in step, eight at a time, without notice after
/// 65,535 turns. Half of that, since these may be the last of one shape and the first of another,
/// which take turns one after the other.
constexpr std::uint32_t max_turns = 30000;

/// Upper bound on the turns that one edge takes such threads: a turn for each row, for each word of
/// a row in which one of them sets cells and, if they are listed, for each of these cells.
std::uint32_t turns_of_edge(const Tile& tile, bool is_boundary, bool is_listed) {
    const std::uint32_t around = tile.width + tile.height;
    return is_listed ? 24 * around : is_boundary ? 4 * around : tile.height + 8;
}

std::uint32_t words_per_row(const Tile& tile) {
    return (tile.width + 31) / 32;
}

/// Reserves a mask; returns its first word.
std::uint32_t add_mask(const Tile& tile, ComputeWork& work) {
    const auto first = static_cast<std::uint32_t>(work.mask_words);
    work.mask_words += std::uint64_t{words_per_row(tile)} * tile.height;
    return first;
}

}  // namespace

void ComputeBuilder::add_mask_shape(const ShapeInTileData& seen, const Tile& tile, double reach,
                                    std::uint32_t first_edge, ComputeWork& work) const {
    // Above this a thread takes the edges of more chunks, so that what is far away is passed over
    // box by box.
    constexpr std::uint32_t many_threads = 256;
    const std::uint32_t places = chunk_size * shapes_.chunks_of(seen);
    const std::uint32_t turns = turns_of_edge(tile, reach >= 0.0, first_edge != no_edges);
    std::uint32_t shift = turns << box_shift <= max_turns ? box_shift : 0;
    while (places >> shift > many_threads && turns << (shift + box_shift) <= max_turns) {
        shift += box_shift;
    }
    work.shapes = &shapes_.shapes();
    work.mask_shapes.push_back({seen, work.mask_threads, rounded_up(reach), first_edge, shift});
    work.mask_threads += (places + (1U << shift) - 1) >> shift;
}

void ComputeBuilder::add_field_tile(const PlannedQuery& query, const Tile& tile,
                                    const FieldTile& field, ComputeWork& work) {
    const bool any_cells = field.first_value != not_asked || field.first_feature != not_asked;
    const std::uint32_t mask = any_cells ? add_mask(tile, work) : 0;
    const ShapeInTileData seen = plan::add_field_tile(query, tile, mask, field.first_value,
                                                      field.first_feature, shapes_, work.fields);
    work.shapes = &shapes_.shapes();
    if (any_cells) {
        add_mask_shape(seen, tile, by_volume, no_edges, work);
    }
}

void ComputeBuilder::add_overlap_tile(const PlannedQuery& query, const Tile& tile,
                                      const OverlapTile& asked, ComputeWork& work) {
    const double reach = query.budget.offset / tile.grid.cell;
    const bool is_volume_a = asked.part_a == Part::volume;
    const bool is_volume_b = asked.part_b == Part::volume;
    OverlapData& data = work.overlaps.emplace_back();
    data.mask_a = add_mask(tile, work);
    data.mask_b = add_mask(tile, work);
    data.size = tile.width | tile.height << 16U;
    data.first_row = work.overlap_rows;
    data.first_edge = no_edges;
    data.tile = asked.tile;
    data.flags = (asked.lists ? overlap_lists : 0U) | (is_volume_a ? overlap_volume_a : 0U) |
                 (is_volume_b ? overlap_volume_b : 0U);
    work.overlap_rows += tile.height;
    if ((asked.lists || asked.keeps_hits) && !is_volume_a) {
        data.first_edge = static_cast<std::uint32_t>(work.edge_words);
        work.edge_words += std::uint64_t{tile.width} * tile.height;
    }
    add_mask_shape(shapes_.see(*query.a, query.pose_a, tile, 0.0, data.mask_a), tile,
                   is_volume_a ? by_volume : reach, data.first_edge, work);
    add_mask_shape(shapes_.see(*query.b, query.pose_b, tile, 0.0, data.mask_b), tile,
                   is_volume_b ? by_volume : reach, no_edges, work);
}

}  // namespace nearfield::plan
