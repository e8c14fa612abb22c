#include <engine/plan/plan.hpp>

namespace nearfield::plan {

double max_points(const PlannedQuery& query) {
    const auto* const penetration = std::get_if<PenetrationQuery>(query.query);
    return penetration != nullptr && penetration->points == PenetrationPoints::vertices
               ? static_cast<double>(query.a->size())
               : max_samples(*query.a, query.budget.cell);
}

void Plan::clear() {
    // Everything but the queries: the planner overwrites each of them, and clearing thousands would
    // write them twice.
    resident.clear();
    searched.clear();
    with_gradient_normals.clear();
    tiles.clear();
    cpu_tiles.clear();
    points.clear();
    field_points.clear();
    extent = {};
    tile_batches = 0;
    raster_tile_batches = 0;
    tiles_by_batch.clear();
    points_by_batch.clear();
    field_points_by_batch.clear();
    result_bytes = 0.0;
    localize_milliseconds = 0.0;
}

}  // namespace nearfield::plan
