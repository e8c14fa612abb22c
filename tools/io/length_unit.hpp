#pragma once

#include <tools/io/names.hpp>

namespace nearfield::tools {

/// The unit of the coordinates that are read from a file: user units are those of the file.
enum class LengthUnit { user, px, mm, cm, inch, pt, pc };

template <>
inline constexpr auto names<LengthUnit> = std::to_array<NamedValue<LengthUnit>>({
    {"user", LengthUnit::user},
    {"px", LengthUnit::px},
    {"mm", LengthUnit::mm},
    {"cm", LengthUnit::cm},
    {"in", LengthUnit::inch},
    {"pt", LengthUnit::pt},
    {"pc", LengthUnit::pc},
});

/// CSS pixels, of which an inch has 96, in a unit; 1 for user units.
[[nodiscard]] double pixels_per(LengthUnit unit);

/// Likewise in a unit of DXF's $INSUNITS; 0 for a code that is not known.
[[nodiscard]] double pixels_of_insunits(double code);

}  // namespace nearfield::tools
