#include <engine/select/default_costs.hpp>

namespace nearfield::select {
namespace {

// Microseconds, measured by `nearfield calibrate` on lavapipe, two cores of an AMD EPYC (Zen 4), in
// several runs, of the device in the quietest, rounded ...
constexpr CostModel on_software{
    .raster = {.submission = 15.0,
               .latency = 140.0,
               .plan = {.points = {2.5, 0.0, 0.047},
                        .closest = {3.8, 0.0067, 0.0},
                        .intersection = {1.8, 0.03, 0.00003},
                        .field = {3.8, 0.07, 0.0, 0.0003},
                        .features = {4.0, 0.025, 0.0, 0.002}},
               .device = {.points = {0.0, 0.0, 0.49},
                          .closest = {2.8, 0.0044, 0.0},
                          .intersection = {2.5, 0.023, 0.0078},
                          .field = {20.0, 0.0, 0.016, 0.01},
                          .features = {15.0, 0.22, 0.003, 0.055}},
               .read = {.points = {0.0, 0.0, 0.029},
                        .closest = {0.9, 0.001, 0.0},
                        .intersection = {0.3, 0.0014, 0.0},
                        .field = {0.4, 0.0018, 0.00042, 0.0},
                        .features = {0.3, 0.004, 0.013, 0.0001}}},
    .compute = {.submission = 12.0,
                .latency = 180.0,
                .plan = {.points = {0.25, 0.006, 0.0},
                         .closest = {3.0, 0.0063, 0.0},
                         .intersection = {1.4, 0.015, 0.0},
                         .field = {0.6, 0.019, 0.0, 0.0},
                         .features = {0.4, 0.016, 0.0, 0.0001}},
                .device = {.points = {0.36, 0.013, 0.024},
                           .closest = {1.0, 0.0059, 0.0},
                           .intersection = {0.83, 0.021, 0.00016},
                           .field = {1.2, 0.059, 0.0013, 0.00038},
                           .features = {0.0, 0.42, 0.0, 0.041}},
                .read = {.points = {0.0, 0.0, 0.0098},
                         .closest = {0.9, 0.001, 0.0},
                         .intersection = {0.15, 0.0015, 0.0},
                         .field = {0.3, 0.0018, 0.00041, 0.0},
                         .features = {0.2, 0.006, 0.013, 0.0001}}},
    .cpu = {.plan = {.points = {0.02, 0.0, 0.0},
                     .closest = {0.03, 0.0, 0.0},
                     .intersection = {1.3, 0.0038, 0.0},
                     .field = {0.08, 0.0001, 0.0, 0.0},
                     .features = {0.08, 0.0002, 0.0, 0.0}},
            .answer = {.points = {0.56, 0.0017, 0.0083},
                       .closest = {0.43, 0.0009, 0.0},
                       .intersection = {1.1, 0.02, 0.00007},
                       .field = {1.1, 0.017, 0.0004, 0.00063},
                       .features = {0.0, 0.059, 0.005, 0.0052}}},
    .overlap = 0.65,
};

// ... and for an NVIDIA H100 beside an Intel Xeon: the sums were measured by an earlier form of
// `nearfield calibrate`; which part is whose follows from docs/measurements/gpu.md for points and
// fields, and from the shares on lavapipe for the rest.
constexpr CostModel on_hardware{
    .raster = {.submission = 60.0,
               .latency = 110.0,
               .plan = {.points = {4.0, 0.05, 0.1},
                        .closest = {5.0, 0.02, 0.0},
                        .intersection = {2.5, 0.03, 0.0002},
                        .field = {4.0, 0.08, 0.0027, 0.0},
                        .features = {0.1, 0.04, 0.0, 0.002}},
               .device = {.points = {0.0, 0.15, 0.15},
                          .closest = {1.0, 0.1, 0.0},
                          .intersection = {1.5, 0.0, 0.0014},
                          .field = {5.0, 0.0, 0.003, 0.001},
                          .features = {0.0, 0.6, 0.02, 0.003}},
               .read = {.points = {0.0, 0.0, 0.05},
                        .closest = {1.0, 0.003, 0.0},
                        .intersection = {0.4, 0.002, 0.0},
                        .field = {0.3, 0.002, 0.0009, 0.0},
                        .features = {0.0, 0.007, 0.025, 0.0}}},
    .compute = {.submission = 40.0,
                .latency = 120.0,
                .plan = {.points = {0.3, 0.012, 0.001},
                         .closest = {2.5, 0.016, 0.0},
                         .intersection = {3.0, 0.03, 0.0},
                         .field = {0.25, 0.03, 0.0, 0.0},
                         .features = {0.1, 0.03, 0.0, 0.0}},
                .device = {.points = {0.1, 0.25, 0.0005},
                           .closest = {0.4, 0.06, 0.0},
                           .intersection = {2.0, 0.0, 0.0007},
                           .field = {0.1, 0.008, 0.0002, 0.0},
                           .features = {0.0, 0.8, 0.03, 0.0}},
                .read = {.points = {0.0, 0.0, 0.016},
                         .closest = {0.6, 0.0013, 0.0},
                         .intersection = {0.4, 0.002, 0.0},
                         .field = {0.15, 0.002, 0.0009, 0.0},
                         .features = {0.0, 0.01, 0.025, 0.0}}},
    .cpu = {.plan = {.points = {0.05, 0.0, 0.0},
                     .closest = {0.06, 0.0, 0.0},
                     .intersection = {2.2, 0.007, 0.0},
                     .field = {0.1, 0.0002, 0.0, 0.0},
                     .features = {0.1, 0.0004, 0.0, 0.0}},
            .answer = {.points = {1.3, 0.0063, 0.018},
                       .closest = {0.6, 0.0013, 0.0},
                       .intersection = {1.0, 0.03, 0.00017},
                       .field = {0.8, 0.028, 0.0005, 0.0018},
                       .features = {0.3, 0.06, 0.01, 0.012}}},
    .overlap = 1.0,
};

}  // namespace

CostModel default_costs(DeviceClass device) {
    return device == DeviceClass::software ? on_software : on_hardware;
}

}  // namespace nearfield::select
