#include <engine/select/default_costs.hpp>

namespace nearfield::select {
namespace {

// Microseconds, measured by `nearfield calibrate` in two runs, rounded: on lavapipe, with
// timestamps of all passes. Without, the device costs less, but by those costs `compute` is chosen
// in nine rows of the standard table where `cpu` takes less time ...
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

// ... and on an NVIDIA H100 beside an Intel Xeon.
constexpr CostModel on_hardware{
    .raster = {.submission = 170.0,
               .points = {0.0, 0.23, 0.3},
               .closest = {7.0, 0.13, 0.0},
               .intersection = {4.4, 0.032, 0.0016},
               .field = {9.6, 0.02, 0.005},
               .features = {0.1, 0.7, 0.052}},
    .compute = {.submission = 280.0,
                .points = {0.0, 0.25, 0.01},
                .closest = {3.5, 0.077, 0.0},
                .intersection = {5.4, 0.006, 0.0007},
                .field = {0.46, 0.015, 0.005},
                .features = {0.0, 0.83, 0.055}},
    .cpu = {.submission = 1.0,
            .points = {1.4, 0.0063, 0.018},
            .closest = {0.65, 0.0013, 0.0},
            .intersection = {3.2, 0.037, 0.00017},
            .field = {0.94, 0.028, 0.0037},
            .features = {0.4, 0.06, 0.054}},
};

}  // namespace

CostModel default_costs(DeviceClass device) {
    return device == DeviceClass::software ? on_software : on_hardware;
}

}  // namespace nearfield::select
