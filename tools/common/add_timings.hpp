#pragma once

#include <nearfield/timings.hpp>

namespace nearfield::tools {

/// Adds the times of what was done after that; those of passes by name.
void add_timings(const Timings& more, Timings& sum);

}  // namespace nearfield::tools
