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

// ... and on an NVIDIA H200 beside an Intel Xeon, the lesser of two runs; what a batch of many
// queries about points, and a large field, cost the device is from `nearfield bench --gpu`.
constexpr CostModel on_hardware{
    .raster = {.submission = 18.0,
               .latency = 53.0,
               .plan = {.points = {5.1, 0.0015, 0.061},
                        .closest = {6.6, 0.013, 0.0},
                        .intersection = {3.7, 0.046, 0.00002},
                        .field = {6.3, 0.085, 0.0, 0.0005},
                        .features = {5.4, 0.0072, 0.0, 0.003}},
               .device = {.points = {0.0, 0.005, 0.044},
                          .closest = {0.0, 0.026, 0.0},
                          .intersection = {0.16, 0.0017, 0.00036},
                          .field = {0.57, 0.0, 0.0001, 0.0006},
                          .features = {0.28, 0.02, 0.0007, 0.0002}},
               .read = {.points = {0.0, 0.0, 0.025},
                        .closest = {1.1, 0.0024, 0.0},
                        .intersection = {0.27, 0.0023, 0.0},
                        .field = {0.28, 0.0022, 0.0004, 0.0},
                        .features = {0.0, 0.0, 0.021, 0.0}}},
    .compute = {.submission = 16.0,
                .latency = 77.0,
                .plan = {.points = {0.24, 0.028, 0.0002},
                         .closest = {5.0, 0.012, 0.0},
                         .intersection = {2.4, 0.025, 0.0},
                         .field = {0.96, 0.02, 0.00002, 0.0},
                         .features = {0.29, 0.03, 0.0004, 0.0}},
                .device = {.points = {0.02, 0.0002, 0.0},
                           .closest = {0.0, 0.029, 0.0},
                           .intersection = {0.06, 0.0096, 0.00015},
                           .field = {0.02, 0.01, 0.00025, 0.0},
                           .features = {0.0, 0.062, 0.0, 0.0006}},
                .read = {.points = {0.08, 0.0023, 0.00007},
                         .closest = {1.0, 0.0023, 0.0},
                         .intersection = {0.26, 0.0025, 0.0},
                         .field = {0.27, 0.0032, 0.0004, 0.0},
                         .features = {0.0, 0.0045, 0.022, 0.0}}},
    .cpu = {.plan = {.points = {0.06, 0.0, 0.0},
                     .closest = {0.06, 0.0, 0.0},
                     .intersection = {2.3, 0.0081, 0.0},
                     .field = {0.16, 0.0004, 0.0, 0.0},
                     .features = {0.15, 0.0006, 0.0, 0.0}},
            .answer = {.points = {0.94, 0.0042, 0.014},
                       .closest = {0.68, 0.0021, 0.0},
                       .intersection = {1.6, 0.043, 0.00014},
                       .field = {1.7, 0.03, 0.0016, 0.0012},
                       .features = {0.0, 0.14, 0.0081, 0.0099}}},
    .overlap = 1.0,
};

}  // namespace

CostModel default_costs(DeviceClass device) {
    return device == DeviceClass::software ? on_software : on_hardware;
}

}  // namespace nearfield::select
