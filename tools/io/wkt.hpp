#pragma once

#include <nearfield/shape.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// Parses the rings of well-known text: POLYGON or MULTIPOLYGON, in any case, with or without Z, M
/// or ZM (only x and y are kept), with or without a leading "SRID=...;". `file` is used in messages
/// of InputError, which give line and column.
[[nodiscard]] std::vector<Ring> parse_wkt(const std::string& text, const std::string& file);

}  // namespace nearfield::tools
