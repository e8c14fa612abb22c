#pragma once

#include <nearfield/curve.hpp>

#include <string>

namespace nearfield::tools {

/// Parses the outlines of an SVG file, all together as one path: path, polygon, polyline, rect,
/// circle and ellipse, in nested groups with transforms. Unsupported elements are rejected by name
/// (text, use, images, style sheets, clipping, lengths with units other than px), except those that
/// draw nothing (title, desc, metadata, defs, elements of other namespaces, display="none").
///
/// Coordinates are the user units of the outermost svg element: its viewBox, width and height are
/// not applied. SVG's y axis points down; y becomes -y here, so that an outline looks as displayed.
/// Paint does not matter: the shape is everything that the outlines enclose by the odd-even rule
/// over all of them, whatever their fill-rule.
///
/// Throws InputError with file, line and column.
[[nodiscard]] CurvePath parse_svg(const std::string& text, const std::string& file);

}  // namespace nearfield::tools
