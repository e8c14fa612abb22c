#pragma once

#include <nearfield/curve.hpp>

#include <tools/io/svg_text.hpp>

namespace nearfield::tools {

/// Parses a transform, as an attribute or as CSS has it (with units): none, or any number of
/// matrix, translate, scale, rotate, skewX, skewY, and of translate and scale along one axis.
/// Throws InputError.
[[nodiscard]] AffineMap parse_transform(SvgText& text);

/// The map that moves by a vector.
[[nodiscard]] AffineMap translation(double x, double y);

/// The map that applies `first`, then `then`.
[[nodiscard]] AffineMap combine(const AffineMap& first, const AffineMap& then);

}  // namespace nearfield::tools
