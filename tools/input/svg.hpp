#pragma once

#include <nearfield/curve.hpp>

#include <string>

namespace nearfield::tools {

/// The outlines of an SVG file, all of them as one path: path, polygon, polyline, rect, circle and
/// ellipse, in nested groups with transforms. What is not read is refused by name (text, use,
/// images, style sheets, clipping, lengths with units other than px), except what draws nothing
/// (title, desc, metadata, defs, elements of other namespaces, display="none").
///
/// Coordinates are the user units of the outermost svg element: its viewBox, width and height are
/// not applied. SVG's y axis points down; it is turned around here (y becomes -y), so that an
/// outline stands as it is seen. Paint does not matter: every outline counts by what it encloses,
/// by the odd-even rule over all of them, whatever its fill-rule.
///
/// Throws InputError with file, line and column.
[[nodiscard]] CurvePath parse_svg(const std::string& text, const std::string& file);

}  // namespace nearfield::tools
