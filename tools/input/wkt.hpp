#pragma once

#include <nearfield/shape.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// The rings of a well-known text: POLYGON or MULTIPOLYGON, in any case, with or without Z, M or
/// ZM (only x and y are kept), with or without a leading "SRID=...;". `file` is for the messages
/// of InputError, which give line and column.
[[nodiscard]] std::vector<Ring> parse_wkt(const std::string& text, const std::string& file);

}  // namespace nearfield::tools
