#pragma once

#include <nearfield/shape.hpp>

#include <tools/input/json_document.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// The rings of GeoJSON: a Polygon or MultiPolygon, a GeometryCollection of them, a Feature of one,
/// or a FeatureCollection. All polygons of a collection together are one shape. Coordinates are
/// planar; those beyond x and y are ignored. `file` is for the messages of InputError.
[[nodiscard]] std::vector<Ring> parse_geojson(const std::string& text, const std::string& file);

/// The rings of one array of rings, [[[x, y], ...], ...], as a GeoJSON Polygon and a scene have it.
void append_rings(const JsonPlace& coordinates, std::vector<Ring>& rings);

}  // namespace nearfield::tools
