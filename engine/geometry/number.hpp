#pragma once

#include <string>

namespace nearfield::geometry {

/// Formats a number with the fewest digits that identify it.
[[nodiscard]] std::string number(double value);

}  // namespace nearfield::geometry
