#pragma once

#include <nearfield/curve.hpp>

#include <tools/input/svg_text.hpp>

#include <string>

namespace nearfield::tools {

/// SVG path data (SVG 1.1, section 8.3): all commands, absolute and relative, in SVG's own
/// coordinates. Subpaths left open are closed, as filling does. Throws InputError.
[[nodiscard]] CurvePath parse_path_data(SvgText& text);

/// A file that holds path data alone. As in an SVG file y points down there: it is turned around,
/// so that the outline stands as it would be seen.
[[nodiscard]] CurvePath parse_path_file(const std::string& text, const std::string& file);

/// From SVG's coordinates, y down, to ours, y up.
inline constexpr AffineMap svg_to_world{{1.0, 0.0}, {0.0, -1.0}, {0.0, 0.0}};

}  // namespace nearfield::tools
