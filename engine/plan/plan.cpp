#include <engine/plan/plan.hpp>

namespace nearfield::plan {

void Plan::clear() {
    // Everything but the queries: the planner overwrites each of them, and clearing thousands would
    // write them twice.
    resident.clear();
    pairs.clear();
    with_gradient_normals.clear();
    tiles.clear();
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
