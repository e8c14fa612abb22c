#pragma once

#include <nearfield/context.hpp>

namespace nearfield {

// Each throws StatusException (invalid_settings) that names the structure and the unusable member.

void check_structure(const HostDevice& host);
void check_structure(const Settings& settings);

}  // namespace nearfield
