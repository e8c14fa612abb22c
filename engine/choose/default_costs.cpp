#include <engine/choose/default_costs.hpp>

namespace nearfield::choose {
namespace {

// Microseconds, as `nearfield calibrate` found them on lavapipe.
constexpr CostModel on_software{
    .raster = {.submission = 250.0,
               .points = {90.0, 0.01, 0.6},
               .closest = {120.0, 0.02, 0.0},
               .intersection = {60.0, 0.02, 0.04},
               .field = {300.0, 0.5, 0.5},
               .features = {300.0, 0.5, 3.0}},
    .compute = {.submission = 150.0,
                .points = {40.0, 0.01, 0.6},
                .closest = {80.0, 0.02, 0.0},
                .intersection = {30.0, 0.02, 0.01},
                .field = {40.0, 0.2, 0.05},
                .features = {40.0, 0.2, 2.0}},
    .cpu = {.submission = 0.0,
            .points = {0.3, 0.01, 0.5},
            .closest = {1.0, 0.05, 0.0},
            .intersection = {1.0, 0.05, 0.001},
            .field = {2.0, 0.05, 0.01},
            .features = {2.0, 0.05, 0.3}},
};

}  // namespace

CostModel default_costs(DeviceClass) {
    return on_software;
}

}  // namespace nearfield::choose
