#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/json_document.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// Parses the rings of GeoJSON: a Polygon or MultiPolygon, a GeometryCollection of them, a Feature
/// with one, or a FeatureCollection. All polygons of a collection form one shape. Coordinates are
/// planar; those beyond x and y are ignored. `file` is used in messages of InputError.
[[nodiscard]] std::vector<Ring> parse_geojson(const std::string& text, const std::string& file);

/// Appends the rings of an array, [[[x, y], ...], ...], as in a GeoJSON Polygon or a scene.
void append_rings(const JsonPlace& coordinates, std::vector<Ring>& rings);

}  // namespace nearfield::tools
