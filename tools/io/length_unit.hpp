#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nearfield::tools {

/// The unit of the coordinates that are read from a file: user units are those of the file.
enum class LengthUnit { user, px, mm, cm, inch, pt, pc };

/// user, px, mm, cm, in, pt or pc. Throws InputError; `what` says where the name stands.
[[nodiscard]] LengthUnit parse_length_unit(const std::string& name, const std::string& what);
/// Likewise; nothing for another name.
[[nodiscard]] std::optional<LengthUnit> find_length_unit(std::string_view name);
/// CSS pixels, of which an inch has 96, in a unit; 1 for user units.
[[nodiscard]] double pixels_per(LengthUnit unit);

/// Likewise in a unit of DXF's $INSUNITS; 0 for a code that is not known.
[[nodiscard]] double pixels_of_insunits(double code);

}  // namespace nearfield::tools
