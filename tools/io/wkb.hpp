#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/skipped_parts.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// The rings of well-known binary: Polygons, MultiPolygons or GeometryCollections, one after the
/// other, in either byte order; ISO WKB, and EWKB with or without an SRID. Only x and y are kept.
/// Points, lines and empty parts are counted in `skipped`; a file with nothing else is refused.
/// `file` is for the messages of InputError, which give the byte, counted from 0.
[[nodiscard]] std::vector<Ring> parse_wkb(const std::string& bytes, const std::string& file,
                                          SkippedParts& skipped,
                                          std::vector<std::uint32_t>* part_sizes = nullptr);

/// True if "\x" or "0x" stand before hexadecimal digits, as some databases write them.
[[nodiscard]] bool is_hex_prefix(std::string_view text);

/// The same from hexadecimal digits, with or without such a prefix. Messages count the bytes that
/// the digits stand for; a character that is no digit is named by line and column.
[[nodiscard]] std::vector<Ring> parse_hex_wkb(const std::string& text, const std::string& file,
                                              SkippedParts& skipped,
                                              std::vector<std::uint32_t>* part_sizes = nullptr);

}  // namespace nearfield::tools
