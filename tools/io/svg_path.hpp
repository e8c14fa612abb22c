#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/svg_document.hpp>

#include <string>

namespace nearfield::tools {

/// Parses SVG path data (SVG 1.1, section 8.3): all commands, absolute and relative, in SVG's own
/// coordinates. Open subpaths are closed, as for filling. Throws InputError.
[[nodiscard]] CurvePath parse_path_data(SvgText& text);

/// Parses a file that contains only path data. As in an SVG file, y points down; it is flipped, so
/// that the outline looks as displayed.
[[nodiscard]] CurvePath parse_path_file(const std::string& text, const std::string& file);

/// Converts SVG coordinates (y down) to world coordinates (y up).
inline constexpr AffineMap svg_to_world{{1.0, 0.0}, {0.0, -1.0}, {0.0, 0.0}};

}  // namespace nearfield::tools
