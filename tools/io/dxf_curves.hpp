#pragma once

#include <tools/io/arc_chain.hpp>
#include <tools/io/dxf_values.hpp>

#include <optional>

namespace nearfield::tools {

/// A SPLINE: a polynomial B-spline of degree 1 to 3, as the Bézier curves that it consists of.
/// Throws InputError for any other.
[[nodiscard]] ArcChain dxf_spline(const DxfValues& values, const DxfEntity& entity);

/// An ELLIPSE.
struct DxfEllipse {
    Vector2 centre;
    double length = 0.0;    ///< of its long half-axis
    double width = 0.0;     ///< of the other one
    double rotation = 0.0;  ///< of the long one, radians
    /// Nothing if it is whole.
    std::optional<ArcChain> arc = std::nullopt;
};
[[nodiscard]] DxfEllipse dxf_ellipse(const DxfValues& values, const DxfEntity& entity);

}  // namespace nearfield::tools
