#include <engine/device_input/current_query.hpp>
#include <engine/geometry/magnitude.hpp>
#include <engine/queries/check_query.hpp>

#include <algorithm>
#include <utility>

namespace nearfield::device_input {

using geometry::BoxedPolygon;

bool check_numbers(const PlannedQuery& planned, const BoxedPolygon& a, const BoxedPolygon& b,
                   ResultSummary& result) {
    result.status =
        queries::check_deviations(result.tolerance, planned.deviations, planned.budget.bound);
    if (result.status.ok()) {
        result.status = queries::check_resolution(
            result.tolerance,
            std::max(geometry::largest_magnitude(a.placed, planned.pose_a, a.box),
                     geometry::largest_magnitude(b.placed, planned.pose_b, b.box)));
    }
    return result.status.ok();
}

void add_tiles(const queries::Regions& regions, TileKind kind, std::uint32_t side,
               std::uint32_t halo, CurrentQuery& current) {
    regions.for_tiles(side, halo, [&](const queries::Tile& cut) {
        PlannedTile& tile = current.plan.tiles.emplace_back();
        static_cast<queries::Tile&>(tile) = cut;
        tile.query = current.index;
        tile.kind = kind;
        if (kind == TileKind::field) {
            tile.needed = NeededBlocks(tile.width, tile.height);
            tile.needed.add_all();
        }
    });
}

std::uint32_t add_reverse(CurrentQuery& current) {
    PlannedQuery reverse = current.planned();
    std::swap(reverse.a, reverse.b);
    std::swap(reverse.pose_a, reverse.pose_b);
    std::swap(reverse.deviations.a, reverse.deviations.b);
    const auto index = static_cast<std::uint32_t>(current.plan.queries.size());
    current.planned().points().reverse = index;
    current.plan.queries.push_back(reverse);
    return index;
}

}  // namespace nearfield::device_input
