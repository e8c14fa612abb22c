#pragma once

#include <string>

namespace nearfield::geometry {

/// A number as text, with as few digits as tell it apart.
[[nodiscard]] std::string number(double value);

}  // namespace nearfield::geometry
