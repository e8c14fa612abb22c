#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/svg_text.hpp>

namespace nearfield::tools {

/// Parses an SVG transform attribute: any number of matrix, translate, scale, rotate, skewX, skewY.
/// Throws InputError.
[[nodiscard]] AffineMap parse_transform(SvgText& text);

/// The map that applies `first`, then `then`.
[[nodiscard]] AffineMap combine(const AffineMap& first, const AffineMap& then);

}  // namespace nearfield::tools
