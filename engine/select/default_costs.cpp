#include <engine/select/default_costs.hpp>

namespace nearfield::select {
namespace {

// Microseconds, measured by `nearfield calibrate` on lavapipe in two runs, rounded.
constexpr CostModel on_software{
    .raster = {.submission = 430.0,
               .points = {76.0, 0.0, 2.9},
               .closest = {208.0, 0.19, 0.0},
               .intersection = {228.0, 0.013, 0.018},
               .field = {253.0, 0.045, 0.07},
               .features = {262.0, 0.3, 0.37}},
    .compute = {.submission = 650.0,
                .points = {12.0, 0.004, 0.12},
                .closest = {13.0, 0.1, 0.0},
                .intersection = {5.9, 0.055, 0.002},
                .field = {1.8, 0.027, 0.018},
                .features = {16.0, 0.34, 0.13}},
    .cpu = {.submission = 0.6,
            .points = {0.8, 0.005, 0.0095},
            .closest = {0.3, 0.0033, 0.0},
            .intersection = {3.3, 0.028, 0.00017},
            .field = {0.77, 0.032, 0.0033},
            .features = {0.4, 0.073, 0.025}},
};

}  // namespace

CostModel default_costs(DeviceClass) {
    return on_software;
}

}  // namespace nearfield::select
