#pragma once

#include <engine/geometry/vector.hpp>
#include <nearfield/curve.hpp>

#include <functional>

namespace nearfield::test {

/// A curve as an explicit formula on [0, 1], written independently of the code under test.
using Formula = std::function<geometry::Vector(double)>;

[[nodiscard]] Formula cubic(geometry::Vector p, geometry::Vector q, geometry::Vector r,
                            geometry::Vector s);
[[nodiscard]] Formula quadratic(geometry::Vector p, geometry::Vector q, geometry::Vector r);
[[nodiscard]] Formula ellipse(geometry::Vector centre, double radius_x, double radius_y,
                              double rotation, double start, double sweep);
/// The conversion from end points to centre in the SVG specification (appendix "Elliptical arc
/// implementation notes"), in extended precision.
[[nodiscard]] Formula svg_arc(geometry::Vector from, geometry::Vector to, EllipticArc arc);

}  // namespace nearfield::test
