#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/skipped_parts.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// The rings of well-known binary: Polygon, MultiPolygon or a GeometryCollection, in either byte
/// order; ISO WKB, and EWKB with or without an SRID. Only x and y are kept. Points, lines and empty
/// parts are counted in `skipped`; a file with nothing else is refused. `file` is for the messages
/// of InputError, which give the byte, counted from 0.
[[nodiscard]] std::vector<Ring> parse_wkb(const std::string& bytes, const std::string& file,
                                          SkippedParts& skipped,
                                          std::vector<std::uint32_t>* part_sizes = nullptr);

/// The same from hexadecimal digits. Messages count the bytes that the digits stand for; a
/// character that is no digit is named by line and column.
[[nodiscard]] std::vector<Ring> parse_hex_wkb(const std::string& text, const std::string& file,
                                              SkippedParts& skipped,
                                              std::vector<std::uint32_t>* part_sizes = nullptr);

}  // namespace nearfield::tools
