#include <engine/base/interruption.hpp>
#include <engine/device_input/compute_batch_builder.hpp>

#include <algorithm>

namespace nearfield::device_input {
namespace {

/// In place of the reach of a boundary.
constexpr double by_volume = -1.0;

/// Some drivers end the loops of threads that run in step, eight at a time, without notice after
/// 65,535 turns. Half of that, since these may be the last of one shape and the first of another,
/// which take turns one after the other.
constexpr std::uint32_t max_turns = 30000;

/// Upper bound on the turns that one edge takes such threads: a turn for each row, for each word of
/// a row in which one of them sets cells and, if they are listed, for each of these cells.
std::uint32_t turns_of_edge(const PlannedTile& tile, bool is_boundary, bool is_listed) {
    const std::uint32_t around = tile.width + tile.height;
    return is_listed ? 24 * around : is_boundary ? 4 * around : tile.height + 8;
}

std::uint32_t words_per_row(const PlannedTile& tile) {
    return (tile.width + 31) / 32;
}

/// Whole words and rows count, and of fields whole regions.
double cells_in_memory(const PlannedTile& tile) {
    const auto whole = [](std::uint32_t cells, std::uint32_t step) {
        const std::uint32_t steps = (cells + step - 1) / step;
        return static_cast<double>(steps) * step;
    };
    return tile.kind == TileKind::field
               ? whole(tile.width, shaders::region_side) * whole(tile.height, shaders::region_side)
               : whole(tile.width, 32) * tile.height;
}

/// Reserves a mask; returns its first word.
std::uint32_t add_mask(const PlannedTile& tile, ComputeWork& work) {
    const auto first = static_cast<std::uint32_t>(work.mask_words);
    work.mask_words += std::uint64_t{words_per_row(tile)} * tile.height;
    return first;
}

}  // namespace

void ComputeBatch::clear() {
    TileBatch::clear();
    work.clear();
    keeps_hits = false;
    resident = false;
}

std::uint32_t ComputeBatchBuilder::build(const Plan& plan, std::uint64_t largest_range,
                                         std::vector<ComputeBatch>& batches) {
    shapes_.begin_batch();
    const std::uint32_t count = build_all(plan, batches);
    // Shapes of earlier batches, or what they left as they grew, must not take up the room.
    if (std::any_of(batches.begin(), batches.begin() + count, [&](const ComputeBatch& batch) {
            return batch.work.shape_bytes() > largest_range;
        })) {
        shapes_.clear();
        return build_all(plan, batches);
    }
    return count;
}

std::uint32_t ComputeBatchBuilder::build_all(const Plan& plan, std::vector<ComputeBatch>& batches) {
    const double most = static_cast<double>(plan.largest_atlas) * plan.largest_atlas;
    double cells = most;
    std::uint32_t count = 0;
    tile_of_plan_.resize(plan.tiles.size());
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const PlannedTile& tile = plan.tiles[i];
        const PlannedQuery& query = plan.queries[tile.query];
        if (query.technique != Technique::compute) {
            continue;
        }
        checkpoint();
        cells += cells_in_memory(tile);
        if (cells > most) {
            cells = cells_in_memory(tile);
            batches.resize(std::max<std::size_t>(batches.size(), ++count));
            batches[count - 1].clear();
        }
        ComputeBatch& batch = batches[count - 1];
        tile_of_plan_[i] = {count - 1, static_cast<std::uint32_t>(batch.work.fields.tiles.size())};
        batch.add_tile(tile, i);
        add_tile(query, tile, batch);
    }
    for (std::uint32_t i = 0; i < plan.field_points.size(); ++i) {
        const queries::PlacedFieldPoint& point = plan.field_points[i];
        const PlannedTile& tile = plan.tiles[point.tile];
        if (plan.queries[tile.query].technique == Technique::compute) {
            const TileOfBatch& of = tile_of_plan_[point.tile];
            add_field_point(tile, of.field_tile, point, batches[of.batch].work.fields);
            batches[of.batch].add_field_point(plan, i);
        }
    }
    return count;
}

void ComputeBatchBuilder::add_tile(const PlannedQuery& query, const PlannedTile& tile,
                                   ComputeBatch& batch) {
    if (tile.kind == TileKind::field) {
        batch.resident = batch.resident || query.on_device;
        add_field_tile(query, tile, batch.add_field_tile(query, tile), batch.work);
        return;
    }
    const OverlapTile overlap =
        batch.add_overlap_tile(std::get<IntersectionQuery>(*query.query), tile);
    batch.keeps_hits = batch.keeps_hits || overlap.keeps_hits;
    add_overlap_tile(query, tile, overlap, batch.work);
}

void ComputeBatchBuilder::add_mask_shape(const shaders::ShapeInTileData& seen,
                                         const PlannedTile& tile, double reach,
                                         std::uint32_t first_edge, ComputeWork& work) const {
    // Above this a thread takes the edges of more chunks, so that what is far away is passed over
    // box by box.
    constexpr std::uint32_t many_threads = 256;
    const std::uint32_t places = shaders::chunk_size * shapes_.chunks_of(seen);
    const std::uint32_t turns = turns_of_edge(tile, reach >= 0.0, first_edge != shaders::no_edges);
    std::uint32_t shift = turns << shaders::box_shift <= max_turns ? shaders::box_shift : 0;
    while (places >> shift > many_threads && turns << (shift + shaders::box_shift) <= max_turns) {
        shift += shaders::box_shift;
    }
    work.shapes = &shapes_.shapes();
    work.mask_shapes.push_back({seen, work.mask_threads, rounded_up(reach), first_edge, shift});
    work.mask_threads += (places + (1U << shift) - 1) >> shift;
}

void ComputeBatchBuilder::add_field_tile(const PlannedQuery& query, const PlannedTile& tile,
                                         const FieldTile& field, ComputeWork& work) {
    const bool any_cells =
        field.first_value != shaders::not_asked || field.first_feature != shaders::not_asked;
    const std::uint32_t mask = any_cells ? add_mask(tile, work) : 0;
    const shaders::ShapeInTileData seen = device_input::add_field_tile(
        query, tile, mask, field.first_value, field.first_feature, shapes_, work.fields);
    work.shapes = &shapes_.shapes();
    if (any_cells) {
        add_mask_shape(seen, tile, by_volume, shaders::no_edges, work);
    }
}

void ComputeBatchBuilder::add_overlap_tile(const PlannedQuery& query, const PlannedTile& tile,
                                           const OverlapTile& asked, ComputeWork& work) {
    const double reach = query.budget.offset / tile.grid.cell;
    const bool is_volume_a = asked.part_a == Part::volume;
    const bool is_volume_b = asked.part_b == Part::volume;
    shaders::OverlapData& data = work.overlaps.emplace_back();
    data.mask_a = add_mask(tile, work);
    data.mask_b = add_mask(tile, work);
    data.size = tile.width | tile.height << 16U;
    data.first_row = work.overlap_rows;
    data.first_edge = shaders::no_edges;
    data.tile = asked.tile;
    data.flags = (asked.lists ? shaders::overlap_lists : 0U) |
                 (is_volume_a ? shaders::overlap_volume_a : 0U) |
                 (is_volume_b ? shaders::overlap_volume_b : 0U);
    work.overlap_rows += tile.height;
    if ((asked.lists || asked.keeps_hits) && !is_volume_a) {
        data.first_edge = static_cast<std::uint32_t>(work.edge_words);
        work.edge_words += std::uint64_t{tile.width} * tile.height;
    }
    add_mask_shape(shapes_.see(*query.a, query.pose_a, tile, 0.0, data.mask_a), tile,
                   is_volume_a ? by_volume : reach, data.first_edge, work);
    add_mask_shape(shapes_.see(*query.b, query.pose_b, tile, 0.0, data.mask_b), tile,
                   is_volume_b ? by_volume : reach, shaders::no_edges, work);
}

}  // namespace nearfield::device_input
