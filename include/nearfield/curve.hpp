#pragma once

#include <nearfield/export.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// \file
/// Outlines with curves, and their tessellation into rings: "higher-order primitives are
/// tessellated into polygons with bounded distance deviation error" (section 2 of the paper).

namespace nearfield {

/// An affine map: it maps a point to origin + x * x_axis + y * y_axis. The default is the identity.
struct AffineMap {
    Vector2 x_axis{1.0, 0.0};  ///< image of the unit vector along x
    Vector2 y_axis{0.0, 1.0};  ///< image of the unit vector along y
    Vector2 origin = {};       ///< image of the origin
};

/// One segment of a contour. It starts at the end of the segment before it.
struct CurveSegment {
    /// The kinds of segments.
    enum class Kind : std::uint8_t {
        line,   ///< a straight line
        cubic,  ///< a cubic Bézier curve
        arc,    ///< an arc of an ellipse, at most half of it
    };
    Kind kind = Kind::line;  ///< which of the members below are used
    Vector2 to = {};         ///< end point
    Vector2 control_1;       ///< cubic: the inner control point next to the start
    Vector2 control_2;       ///< cubic: the inner control point next to the end
    /// Arc: point(s) = centre + cos(s) apex + sin(s) along for s from -half_sweep to half_sweep.
    /// The centre is the midpoint of the end points minus cos(half_sweep) apex; it is not stored,
    /// so a short arc of a huge circle loses no digits. `apex` is the vector from the centre to the
    /// middle of the arc.
    Vector2 apex = {};
    Vector2 along = {};       ///< arc: the conjugate half-diameter, in the direction of travel
    double half_sweep = 0.0;  ///< arc: radians, above 0 and at most pi
};

/// One closed outline. If the last segment does not end at the start, a straight line closes it.
struct CurveContour {
    Vector2 start = {};                  ///< start of the first segment
    std::vector<CurveSegment> segments;  ///< each starts at the end of the one before it
};

/// An elliptic arc in SVG's end-point parameters.
struct EllipticArc {
    double radius_x = 0.0;  ///< half-axis along the ellipse's x; sign ignored; 0: a straight line
    double radius_y = 0.0;  ///< half-axis along the ellipse's y; sign ignored; 0: a straight line
    double rotation = 0.0;  ///< angle of the ellipse's x axis, radians, counter-clockwise
    bool large = false;     ///< SVG's large-arc flag: one of the two arcs longer than half a turn
    bool counter_clockwise = true;  ///< direction of travel, from the x axis towards the y axis
};

/// Outlines of straight lines, Bézier curves, elliptic arcs and splines, in the shape's own
/// coordinates. All contours together are one shape, filled by the odd-even rule like rings.
///
/// Invalid input (a segment before the first point, a number that is not finite) is recorded, and
/// tessellate() reports it. Not thread-safe; different paths are independent.
class NEARFIELD_EXPORT CurvePath {
public:
    /// Starts a contour and closes the one before it.
    CurvePath& move_to(Vector2 start);
    /// A straight line from the current point.
    CurvePath& line_to(Vector2 to);
    /// A quadratic Bézier curve from the current point.
    CurvePath& quadratic_to(Vector2 control, Vector2 to);
    /// A cubic Bézier curve from the current point.
    CurvePath& cubic_to(Vector2 control_1, Vector2 control_2, Vector2 to);

    /// An arc of an ellipse from the current point, in end-point form. As in SVG, an ellipse too
    /// small to reach `to` is scaled up until it does, and an arc to the current point is omitted.
    CurvePath& arc_to(const EllipticArc& arc, Vector2 to);
    /// An arc of a circle from the current point, in centre form: turns about `centre` by `sweep`
    /// radians, positive counter-clockwise, at most a full turn in either direction.
    CurvePath& arc_about(Vector2 centre, double sweep);

    /// Closes the contour at its start. Segments that follow without a move_to() start there.
    CurvePath& close();

    /// Adds a separate contour: a full circle, counter-clockwise.
    CurvePath& circle(Vector2 centre, double radius);
    /// Adds a separate contour: a full ellipse, counter-clockwise. The radii are half-axes;
    /// `rotation` is the angle of its x axis in radians, counter-clockwise.
    CurvePath& ellipse(Vector2 centre, double radius_x, double radius_y, double rotation = 0.0);
    /// Adds a separate contour: the closed centripetal Catmull-Rom spline through the points, which
    /// has neither cusps nor loops between neighbouring points. Points equal to the one before them
    /// are dropped; at least three must remain.
    CurvePath& catmull_rom(std::span<const Vector2> points);

    /// Adds all contours of another path.
    CurvePath& append(const CurvePath& other);
    /// Applies a map to all contours so far. Curves stay exact: a circle becomes an ellipse.
    CurvePath& transform(const AffineMap& map);

    /// All contours so far. Borrowed until the path changes.
    [[nodiscard]] std::span<const CurveContour> contours() const noexcept { return contours_; }
    /// The first invalid input, as a message; empty if there was none.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

private:
    [[nodiscard]] Vector2 current() const;
    void add(const char* what, const CurveSegment& segment);
    void refuse(const char* what, const char* why);

    std::vector<CurveContour> contours_;
    bool open_ = false;  // the last contour takes further segments
    std::string problem_;
};

/// Tessellates a path: one ring per contour, in order; contours without segments are skipped. Every
/// vertex lies on the curve. `deviation` (> 0, in the units of the path) bounds the Hausdorff
/// distance between contour and ring, rounding included: no point of either is farther than that
/// from the other. A point farther than `deviation` from the ring is on the same side of both. Pass
/// the same number to Context::add_shape, and the error bounds of all results hold for the curves.
///
/// Rotating or translating a path does the same to its rings, up to rounding. Circles get as few
/// edges as equal division allows; other curves at most about twice the minimum, plus a few at each
/// point where the curve reverses (derivation in docs/error_budget.md). A contour with curves that
/// would get fewer than three vertices is divided further.
///
/// Fails with invalid_shape if the path is invalid (no contour, a number that is not finite or
/// exceeds `largest_coordinate`, a segment before the first point) or the deviation is not above 0
/// or is below what double precision resolves at these coordinates; with too_large if more than
/// `most` vertices would be needed; with out_of_memory. The output is never truncated. Thread-safe
/// for different paths.
[[nodiscard]] NEARFIELD_EXPORT Expected<std::vector<Ring>> tessellate(
    const CurvePath& path, double deviation, std::uint32_t most = max_vertices);

}  // namespace nearfield
