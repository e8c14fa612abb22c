#pragma once

#include <tools/cli/simulate.hpp>
#include <tools/simulation/clearance_scene.hpp>

namespace nearfield::tools {

/// Runs a scene of clearances as run_simulate() does.
[[nodiscard]] int run_clearances(const SimulateArguments& arguments,
                                 const simulation::NamedClearanceScene& named);

}  // namespace nearfield::tools
