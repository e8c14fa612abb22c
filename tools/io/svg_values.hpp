#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/svg_document.hpp>
#include <tools/io/values.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

/// Parses a transform, as an attribute or as CSS has it (with units): none, or any number of
/// matrix, translate, scale, rotate, skewX, skewY, and of translate and scale along one axis.
/// Throws InputError.
[[nodiscard]] AffineMap parse_transform(SvgText& text);

/// The map that moves by a vector.
[[nodiscard]] AffineMap translation(double x, double y);

/// The map that applies `first`, then `then`.
[[nodiscard]] AffineMap combine(const AffineMap& first, const AffineMap& then);

/// What percentages refer to: the size of the innermost viewport, in user units.
struct SvgViewport {
    double width = 0.0;
    double height = 0.0;
};

/// The direction of a length, which decides what a percentage of it is.
enum class SvgAxis { x, y, other };

/// A whole value as a length: a number alone is in user units, and so is the result. The units are
/// px, mm, cm, Q, in, pt, pc and, where there is a viewport, %.
[[nodiscard]] double parse_length(SvgText text, SvgAxis axis,
                                  const std::optional<SvgViewport>& viewport);

/// A property that is a length; nothing where it is not set, or "auto".
[[nodiscard]] std::optional<double> svg_length(const SvgDocument& document,
                                               const pugi::xml_node& node, const char* name,
                                               SvgAxis axis,
                                               const std::optional<SvgViewport>& viewport);

/// Where the content of an element with a viewBox goes.
struct SvgViewBox {
    AffineMap map = {};    ///< from the coordinates of its content to those around it
    SvgViewport viewport;  ///< in the coordinates of its content
};

/// The viewBox of an svg or symbol element that is shown at (0, 0) in a size; nothing if it has
/// none. Throws InputError for numbers that make no sense.
[[nodiscard]] std::optional<SvgViewBox> svg_view_box(const SvgDocument& document,
                                                     const pugi::xml_node& node,
                                                     const std::optional<SvgViewport>& size);

/// Parses SVG path data (SVG 1.1, section 8.3): all commands, absolute and relative, in SVG's own
/// coordinates. Open subpaths are closed, as for filling. Throws InputError.
[[nodiscard]] CurvePath parse_path_data(SvgText& text);

/// Parses a file that contains only path data. As in an SVG file, y points down; it is flipped, so
/// that the outline looks as displayed.
[[nodiscard]] CurvePath parse_path_file(const std::string& text, const std::string& file);

/// Converts SVG coordinates (y down) to world coordinates (y up).
inline constexpr AffineMap svg_to_world{{1.0, 0.0}, {0.0, -1.0}, {0.0, 0.0}};

/// True of path, polygon, polyline, rect, circle and ellipse.
[[nodiscard]] bool is_svg_shape(std::string_view name);

/// The outline of such an element, in its own coordinates; empty where a size is 0, which draws
/// nothing. Throws InputError with the place.
[[nodiscard]] CurvePath read_svg_shape(const SvgDocument& document, const pugi::xml_node& node,
                                       const std::optional<SvgViewport>& viewport);

}  // namespace nearfield::tools
