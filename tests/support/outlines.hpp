#pragma once

#include <tests/support/polygons.hpp>

#include <filesystem>

namespace nearfield::test {

/// Reads a GeoJSON feature with a Polygon or MultiPolygon. Throws std::runtime_error with the
/// file's name if there is none.
NamedRings read_outline(const std::filesystem::path& file);

/// Reads all outlines of a folder in the order of their names.
std::vector<NamedRings> read_outlines(const std::filesystem::path& folder);

}  // namespace nearfield::test
