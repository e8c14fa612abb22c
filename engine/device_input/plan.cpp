#include <engine/device_input/plan.hpp>

namespace nearfield::device_input {

void Plan::clear() {
    // Everything but the queries: the planner overwrites each of them, and clearing thousands would
    // write them twice.
    resident.clear();
    pairs.clear();
    tiles.clear();
    points.clear();
    field_points.clear();
    result_bytes = 0.0;
    localize_milliseconds = 0.0;
}

}  // namespace nearfield::device_input
