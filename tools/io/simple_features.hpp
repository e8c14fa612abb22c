#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/json_document.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {

/// What a file holds besides polygons (points, lines, empty parts), counted by kind: a shape is
/// made without it, and whoever reads the file is told.
class SkippedParts {
public:
    void add(std::string_view kind, std::size_t count = 1);
    [[nodiscard]] bool empty() const noexcept { return counts_.empty(); }
    /// "Point (2), empty part (1)", in the order in which the kinds were first met.
    [[nodiscard]] std::string text() const;
    /// Why a file without a single polygon is refused.
    [[nodiscard]] std::string no_polygon_text() const;

private:
    std::vector<std::pair<std::string, std::size_t>> counts_;
};

/// Collections nest no deeper: untrusted input must not exhaust the stack.
inline constexpr int deepest_collection = 64;

/// The kind under which empty geometries and rings are counted.
inline constexpr std::string_view empty_part = "empty part";

/// The rings of GeoJSON: a Polygon or MultiPolygon, a GeometryCollection, a Feature, a
/// FeatureCollection, or a sequence of these, one a line (RFC 8142, or without its separators). All
/// polygons together are one shape. Points, lines, empty polygons and features without geometry are
/// counted in `skipped`; a document with nothing else is refused, and so is an unknown type.
/// Coordinates are planar; those beyond x and y are ignored. `file` is for the messages of
/// InputError.
[[nodiscard]] std::vector<Ring> parse_geojson(const std::string& text, const std::string& file,
                                              SkippedParts& skipped,
                                              std::vector<std::uint32_t>* part_sizes = nullptr);
/// Likewise, where nobody is to be told what was skipped.
[[nodiscard]] std::vector<Ring> parse_geojson(const std::string& text, const std::string& file);

/// Appends the rings of an array, [[[x, y], ...], ...], as in a GeoJSON Polygon or a scene.
void append_rings(const JsonPlace& coordinates, std::vector<Ring>& rings);

/// The rings of a well-known text: POLYGON, MULTIPOLYGON or a GEOMETRYCOLLECTION, in any case, with
/// or without Z, M or ZM (only x and y are kept), a leading "SRID=...;" and a trailing semicolon.
/// Points, lines and EMPTY parts are counted in `skipped`; a text with nothing else is refused.
/// Curves and surfaces that hold areas of another kind are refused by name. `file` is for the
/// messages of InputError, which give line and column. `part_sizes`, if given, receives the number
/// of rings of each polygon.
[[nodiscard]] std::vector<Ring> parse_wkt(const std::string& text, const std::string& file,
                                          SkippedParts& skipped,
                                          std::vector<std::uint32_t>* part_sizes = nullptr);

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
