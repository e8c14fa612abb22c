#pragma once

#include <nearfield/cost.hpp>

namespace nearfield::choose {

/// What a device is made of, as far as costs go.
enum class DeviceClass {
    software,  ///< the processor itself, as lavapipe
    hardware,
};

/// What holds until a machine's own costs are measured; docs/performance.md says where the numbers
/// come from.
[[nodiscard]] CostModel default_costs(DeviceClass device);

}  // namespace nearfield::choose
