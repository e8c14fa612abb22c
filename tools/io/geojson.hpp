#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/json_document.hpp>
#include <tools/io/skipped_parts.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

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

}  // namespace nearfield::tools
