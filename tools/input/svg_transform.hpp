#pragma once

#include <nearfield/curve.hpp>

#include <tools/input/svg_text.hpp>

namespace nearfield::tools {

/// An SVG transform attribute: matrix, translate, scale, rotate, skewX, skewY, in any number.
/// Throws InputError.
[[nodiscard]] AffineMap parse_transform(SvgText& text);

/// The map that does `first`, then `then`.
[[nodiscard]] AffineMap combine(const AffineMap& first, const AffineMap& then);

}  // namespace nearfield::tools
