#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/geometry/offset_mesh.hpp>
#include <engine/plan/overlap_boundary.hpp>
#include <engine/plan/tile_batch.hpp>
#include <engine/plan/tile_triangles.hpp>

#include <algorithm>
#include <string>

namespace nearfield::plan {

// The part of TileBatchBuilder that prepares tiles of intersections for the raster.

using geometry::Mesh;

namespace {

// Minimum cells of a tile for an occlusion query, which costs about as much as searching this many
// samples (docs/performance.md) and gains nothing if some pass.
constexpr std::uint32_t smallest_watched = 128U * 128U;

/// With stencil or depth, only samples of the intersection pass while A is drawn. Where colour
/// decides, all of A passes, so the occlusion query says too little.
bool worth_watching(IntersectionStrategy strategy, const Tile& tile) {
    return (strategy == IntersectionStrategy::stencil || strategy == IntersectionStrategy::depth) &&
           tile.width * tile.height >= smallest_watched;
}

}  // namespace

/// Selects the largest tiles that are worth an occlusion query.
void TileBatchBuilder::select_watched(const Plan& plan, std::uint32_t number) {
    watched_.clear();
    if (number >= plan.raster_tile_batches) {
        return;
    }
    const auto is_larger = [&](std::uint32_t i, std::uint32_t j) {
        return plan.tiles[i].width * plan.tiles[i].height >
               plan.tiles[j].width * plan.tiles[j].height;
    };
    for (const std::uint32_t i : plan.tiles_by_batch.of(number)) {
        const Tile& tile = plan.tiles[i];
        if (tile.kind != TileKind::overlap) {
            continue;
        }
        const auto& query = std::get<IntersectionQuery>(*plan.queries[tile.query].query);
        if (worth_watching(query.strategy, tile)) {
            watched_.insert(std::upper_bound(watched_.begin(), watched_.end(), i, is_larger), i);
            watched_.resize(std::min<std::size_t>(watched_.size(), max_watched));
        }
    }
}

OverlapTile TileBatchBuilder::describe_overlap(const IntersectionQuery& query, const Tile& tile,
                                               TileBatch& batch) {
    const bool volumes = query.kind == IntersectionKind::volume_volume;
    const bool boundaries = query.kind == IntersectionKind::boundary_boundary;
    OverlapTile overlap;
    overlap.tile = static_cast<std::uint32_t>(batch.tiles.size() - 1);
    overlap.part_a = volumes ? Part::volume : Part::boundary;
    overlap.part_b = boundaries ? Part::boundary : Part::volume;
    overlap.lists = !query.summary_only;
    overlap.keeps_hits = query.on_device && query.samples_on_device;
    batch.listed_cells += overlap.lists ? std::uint64_t{tile.width} * tile.height : 0;
    batch.keeps_hits = batch.keeps_hits || overlap.keeps_hits;
    return overlap;
}

void TileBatchBuilder::add_boundary(const TileBoundary& boundary, const Tile& tile, double offset,
                                    std::vector<EdgeRun>* runs, Mesh& mesh) const {
    const std::size_t first = mesh.size();
    SparseCheckpoint<64> checkpoint;
    boundary.for_offset_edges(tile.width, tile.height, offset, [&](std::uint32_t i) {
        checkpoint.step();
        const std::size_t before = mesh.size();
        const auto run = runs != nullptr ? static_cast<std::uint32_t>(runs->size()) : 0U;
        if (run == max_runs) {
            throw StatusException(
                {StatusCode::too_large, "the boundaries of one tile batch have more than " +
                                            std::to_string(max_runs) +
                                            " edges; use a larger tolerance"});
        }
        geometry::append_offset_polygon(boundary.start(i), boundary.end(i), offset, tile.width,
                                        tile.height, grid_, run << run_shift, mesh);
        if (runs != nullptr && mesh.size() > before) {
            runs->push_back({boundary.edge(i).first, boundary.edge(i).count});
        }
    });
    move_to_atlas(tile, first, mesh);
}

void TileBatchBuilder::add_overlap_tile(const PlannedQuery& query, const Tile& tile,
                                        TileBatch& batch) {
    const auto& asked = std::get<IntersectionQuery>(*query.query);
    RasterWork& work = batch.raster;
    const OverlapTile drawn = describe_overlap(asked, tile, batch);
    add_groups(tile, overlap_group_width, overlap_group_height,
               {drawn.tile, 0, drawn.lists ? 1U : 0U, 0}, work.groups[group_list(asked.strategy)]);
    add_rectangle(tile, work.meshes[overlaps_of(asked.strategy, OverlapStep::clear)]);
    add_overlap_b(query, tile, drawn, batch);
    add_overlap_a(query, tile, drawn, batch);
    work.overlaps[static_cast<std::size_t>(asked.strategy)].push_back(drawn);
}

void TileBatchBuilder::add_volume(const TileBoundary& boundary, const Tile& tile, double slack,
                                  Mesh& parity, Mesh& rectangles) {
    crossing_.clear();
    crossing_edges(boundary, tile.width, tile.height, slack, crossing_);
    add_fill(crossing_, tile, parity);
    add_rectangle(tile, rectangles);
}

void TileBatchBuilder::add_overlap_b(const PlannedQuery& query, const Tile& tile,
                                     const OverlapTile& overlap, TileBatch& batch) {
    const auto strategy = std::get<IntersectionQuery>(*query.query).strategy;
    const auto mesh = [&](OverlapStep step) -> Mesh& {
        return batch.raster.meshes[overlaps_of(strategy, step)];
    };
    const double cell = tile.grid.cell;
    const TileBoundary boundary =
        overlap_boundary(*query.b, query.pose_b, query.budget, tile, shapes_);
    if (overlap.part_b == Part::boundary) {
        add_boundary(boundary, tile, query.budget.offset / cell, nullptr,
                     mesh(OverlapStep::boundary_b));
    } else {
        add_volume(boundary, tile, query.budget.simplification / cell, mesh(OverlapStep::parity_b),
                   mesh(OverlapStep::volume_b));
    }
}

void TileBatchBuilder::add_overlap_a(const PlannedQuery& query, const Tile& tile,
                                     const OverlapTile& overlap, TileBatch& batch) {
    const auto strategy = std::get<IntersectionQuery>(*query.query).strategy;
    const auto mesh = [&](OverlapStep step) -> Mesh& {
        return batch.raster.meshes[overlaps_of(strategy, step)];
    };
    const bool is_watched = std::find(watched_.begin(), watched_.end(),
                                      batch.tile_index[overlap.tile]) != watched_.end();
    Mesh& drawn = is_watched                         ? mesh(OverlapStep::watched_a)
                  : overlap.part_a == Part::boundary ? mesh(OverlapStep::boundary_a)
                                                     : mesh(OverlapStep::volume_a);
    const auto first = static_cast<std::uint32_t>(drawn.size());
    const double cell = tile.grid.cell;
    const TileBoundary boundary =
        overlap_boundary(*query.a, query.pose_a, query.budget, tile, shapes_);
    if (overlap.part_a == Part::boundary) {
        add_boundary(boundary, tile, query.budget.offset / cell, &batch.runs, drawn);
    } else {
        add_volume(boundary, tile, query.budget.simplification / cell, mesh(OverlapStep::parity_a),
                   drawn);
    }
    if (is_watched) {
        const auto count = static_cast<std::uint32_t>(drawn.size()) - first;
        batch.raster.watched.push_back({overlap.tile, strategy, overlap.part_a, {first, count}});
    }
}

}  // namespace nearfield::plan
