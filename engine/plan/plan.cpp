#include <engine/plan/plan.hpp>

namespace nearfield::plan {

void Plan::clear() {
    // But for the queries: the planner writes each anew, and thousands would be written twice.
    resident.clear();
    with_gradient_normals.clear();
    tiles.clear();
    cpu_tiles.clear();
    points.clear();
    field_points.clear();
    extent = {};
    rounds = 0;
    raster_rounds = 0;
    tiles_by_round.clear();
    points_by_round.clear();
    field_points_by_round.clear();
    result_bytes = 0.0;
}

}  // namespace nearfield::plan
