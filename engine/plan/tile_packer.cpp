#include <engine/plan/compute_work.hpp>
#include <engine/plan/tile_packer.hpp>

namespace nearfield::plan {

/// A tile batch of the compute technique takes as many cells as an atlas image has, which bounds
/// the memory for masks and lists. Whole words and rows count, and of fields whole regions.
void TilePacker::add_compute_tile_batches(Plan& plan) const {
    const auto whole = [](std::uint32_t cells, std::uint32_t step) {
        const std::uint32_t steps = (cells + step - 1) / step;
        return static_cast<double>(steps) * step;
    };
    const double most = static_cast<double>(largest_atlas_) * largest_atlas_;
    double cells = most;
    for (Tile& tile : plan.tiles) {
        if (plan.queries[tile.query].technique != Technique::compute) {
            continue;
        }
        const double own = tile.kind == TileKind::field
                               ? whole(tile.width, region_side) * whole(tile.height, region_side)
                               : whole(tile.width, 32) * tile.height;
        cells += own;
        if (cells > most) {
            ++plan.tile_batches;
            cells = own;
        }
        tile.place = {plan.tile_batches - 1, 0, 0};
    }
}

/// Distances, and intersections by each strategy, have tile batches of their own, so that the draws
/// of a tile batch stay few whatever queries are mixed.
void TilePacker::pack_drawn_tiles(Plan& plan) {
    for (DrawnTogether& group : drawn_together_) {
        group.tiles.clear();
        group.sizes.clear();
    }
    for (std::uint32_t i = 0; i < plan.tiles.size(); ++i) {
        const Tile& tile = plan.tiles[i];
        const PlannedQuery& planned = plan.queries[tile.query];
        if (planned.technique != Technique::compute) {
            const auto* const overlap = std::get_if<IntersectionQuery>(planned.query);
            DrawnTogether& group =
                drawn_together_[overlap == nullptr
                                    ? 0
                                    : 1 + static_cast<std::size_t>(overlap->strategy)];
            group.tiles.push_back(i);
            group.sizes.push_back({tile.width, tile.height});
        }
    }
    atlas_.clear();
    for (const DrawnTogether& group : drawn_together_) {
        atlas_.pack(group.sizes, places_);
        for (std::size_t i = 0; i < group.tiles.size(); ++i) {
            plan.tiles[group.tiles[i]].place = places_[i];
        }
    }
}

void TilePacker::pack(Plan& plan) {
    pack_drawn_tiles(plan);
    plan.extent = atlas_.extent();
    plan.tile_batches = atlas_.tile_batches();
    plan.raster_tile_batches = plan.tile_batches;
    add_compute_tile_batches(plan);
    const std::vector<Tile>& tiles = plan.tiles;
    const std::vector<PlannedPoint>& points = plan.points;
    const std::vector<PlannedFieldPoint>& field_points = plan.field_points;
    plan.tiles_by_batch.sort(tiles.size(), plan.tile_batches,
                             [&](std::size_t i) { return tiles[i].place.tile_batch; });
    plan.points_by_batch.sort(points.size(), plan.tile_batches, [&](std::size_t i) {
        return tiles[points[i].tile].place.tile_batch;
    });
    plan.field_points_by_batch.sort(field_points.size(), plan.tile_batches, [&](std::size_t i) {
        return tiles[field_points[i].tile].place.tile_batch;
    });
}

}  // namespace nearfield::plan
