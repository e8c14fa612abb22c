#include <engine/select/default_costs.hpp>

namespace nearfield::select {
namespace {

// Microseconds, measured by `nearfield calibrate` on lavapipe, two cores of an AMD EPYC (Zen 4), in
// several runs, of the device in the quietest, rounded ...
constexpr CostModel on_software{
    .raster = {.submission = 17.0,
               .latency = 160.0,
               .plan = {.points = {3.5, 0.0, 0.052, 0.0, 0.0},
                        .closest = {3.8, 0.0006, 0.0, 0.0, 0.012},
                        .intersection = {2.2, 0.003, 0.00003, 0.0, 0.027},
                        .field = {4.0, 0.035, 0.0, 0.00028, 0.023},
                        .features = {3.6, 0.003, 0.0, 0.002, 0.016}},
               .device = {.points = {0.0, 0.0, 0.7, 0.0, 0.0},
                          .closest = {3.7, 0.0039, 0.0, 0.0, 0.0},
                          .intersection = {4.1, 0.01, 0.0078, 0.0, 0.0},
                          .field = {14.0, 0.0, 0.0145, 0.011, 0.0},
                          .features = {12.0, 0.24, 0.0, 0.054, 0.0}},
               .read = {.points = {0.03, 0.0, 0.017, 0.0, 0.0},
                        .closest = {0.67, 0.0, 0.0, 0.0, 0.0022},
                        .intersection = {0.17, 0.0, 0.0, 0.0, 0.0014},
                        .field = {0.25, 0.0, 0.00044, 0.0, 0.0014},
                        .features = {0.1, 0.001, 0.0135, 0.0002, 0.0}}},
    .compute = {.submission = 15.0,
                .latency = 190.0,
                .plan = {.points = {0.25, 0.0, 0.0001, 0.0, 0.013},
                         .intersection = {1.5, 0.0008, 0.0, 0.0, 0.0155},
                         .field = {0.47, 0.0, 0.0, 0.00002, 0.012},
                         .features = {0.1, 0.0, 0.0, 0.00017, 0.0135}},
                .device = {.points = {0.1, 0.006, 0.0255, 0.0, 0.0015},
                           .intersection = {0.5, 0.014, 0.00017, 0.0, 0.001},
                           .field = {1.2, 0.059, 0.0013, 0.00038, 0.0},
                           .features = {0.0, 0.33, 0.0, 0.0405, 0.01}},
                .read = {.points = {0.072, 0.0005, 0.0001, 0.0, 0.0007},
                         .intersection = {0.165, 0.0008, 0.0, 0.0, 0.0002},
                         .field = {0.19, 0.0, 0.00043, 0.0, 0.0009},
                         .features = {0.0, 0.0, 0.0133, 0.00015, 0.002}}},
    .cpu = {.plan = {.points = {0.03, 0.0, 0.0, 0.0, 0.0},
                     .closest = {0.038, 0.0, 0.0, 0.0, 0.0},
                     .intersection = {1.36, 0.0034, 0.0, 0.0, 0.0002},
                     .field = {0.093, 0.0, 0.0, 0.0, 0.00015},
                     .features = {0.094, 0.0001, 0.0, 0.0, 0.0001}},
            .answer = {.points = {0.57, 0.0, 0.0086, 0.0, 0.0036},
                       .closest = {0.43, 0.0, 0.0, 0.0, 0.002},
                       .intersection = {1.15, 0.0, 0.00007, 0.0, 0.026},
                       .field = {1.14, 0.0, 0.00042, 0.00064, 0.017},
                       .features = {0.0, 0.053, 0.005, 0.0052, 0.006}}},
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
                .plan = {.points = {0.24, 0.0, 0.0002, 0.0, 0.028},
                         .intersection = {2.4, 0.025, 0.0},
                         .field = {0.96, 0.02, 0.00002, 0.0},
                         .features = {0.29, 0.03, 0.0004, 0.0}},
                .device = {.points = {0.02, 0.0002, 0.0},
                           .intersection = {0.06, 0.0096, 0.00015},
                           .field = {0.02, 0.01, 0.00025, 0.0},
                           .features = {0.0, 0.062, 0.0, 0.0006}},
                .read = {.points = {0.08, 0.0023, 0.00007},
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
