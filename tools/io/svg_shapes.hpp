#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/svg_length.hpp>

namespace nearfield::tools {

/// True of path, polygon, polyline, rect, circle and ellipse.
[[nodiscard]] bool is_svg_shape(std::string_view name);

/// The outline of such an element, in its own coordinates; empty where a size is 0, which draws
/// nothing. Throws InputError with the place.
[[nodiscard]] CurvePath read_svg_shape(const SvgDocument& document, const pugi::xml_node& node,
                                       const std::optional<SvgViewport>& viewport);

}  // namespace nearfield::tools
