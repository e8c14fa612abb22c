#pragma once

#include <nearfield/shape.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// The rings of a GeoJSON or WKT file. The extension (.geojson, .json, .wkt) says which it is; with
/// any other the first character does. Throws InputError.
[[nodiscard]] std::vector<Ring> read_outline(const std::string& path);

}  // namespace nearfield::tools
