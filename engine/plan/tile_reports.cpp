#include <engine/plan/tile_reports.hpp>

namespace nearfield::plan {

void report_tiles(const Plan& plan, std::vector<TileReport>& reports) {
    reports.reserve(reports.size() + plan.tiles.size());
    for (const Tile& tile : plan.tiles) {
        const PlannedQuery& planned = plan.queries[tile.query];
        const geometry::Vector low = tile.origin();
        const geometry::Vector high =
            low + tile.grid.cell * geometry::Vector(tile.width, tile.height);
        TileReport& report = reports.emplace_back();
        report.query = planned.index;
        report.technique = planned.technique;
        // The other direction of a query follows all queries of the batch.
        report.side = planned.index == tile.query ? Side::a : Side::b;
        report.min = geometry::to_public(low);
        report.max = geometry::to_public(high);
        report.width = tile.width;
        report.height = tile.height;
        report.tile_batch = tile.place.tile_batch;
        report.x = tile.place.x;
        report.y = tile.place.y;
    }
}

}  // namespace nearfield::plan
