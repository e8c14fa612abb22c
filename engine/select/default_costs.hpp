#pragma once

#include <nearfield/cost.hpp>

namespace nearfield::select {

/// Kinds of devices that differ in their costs.
enum class DeviceClass {
    software,  ///< runs on the CPU, such as lavapipe
    hardware,
};

/// The cost model used until a machine's own costs are measured; docs/performance.md gives the
/// origin of the numbers.
[[nodiscard]] CostModel default_costs(DeviceClass device);

}  // namespace nearfield::select
