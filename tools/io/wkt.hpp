#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/skipped_parts.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The rings of a well-known text: POLYGON, MULTIPOLYGON or a GEOMETRYCOLLECTION, in any case, with
/// or without Z, M or ZM (only x and y are kept), a leading "SRID=...;" and a trailing semicolon.
/// Points, lines and EMPTY parts are counted in `skipped`; a text with nothing else is refused.
/// Curves and surfaces that hold areas of another kind are refused by name. `file` is for the
/// messages of InputError, which give line and column. `part_sizes`, if given, receives the number
/// of rings of each polygon.
[[nodiscard]] std::vector<Ring> parse_wkt(const std::string& text, const std::string& file,
                                          SkippedParts& skipped,
                                          std::vector<std::uint32_t>* part_sizes = nullptr);

}  // namespace nearfield::tools
