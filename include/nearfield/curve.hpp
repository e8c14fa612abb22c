#pragma once

#include <nearfield/export.hpp>
#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// \file
/// Outlines with curves, and the way from them to rings: "higher-order primitives are tessellated
/// into polygons with bounded distance deviation error" (the paper's section 2).

namespace nearfield {

/// An affine map: a point goes to origin + x * x_axis + y * y_axis. The default leaves all as it
/// is.
struct AffineMap {
    Vector2 x_axis{1.0, 0.0};  ///< where the unit vector along x goes
    Vector2 y_axis{0.0, 1.0};  ///< where the unit vector along y goes
    Vector2 origin = {};       ///< where the origin goes
};

/// One piece of an outline, from where the piece before it ends.
struct CurveSegment {
    /// What kinds of pieces there are.
    enum class Kind : std::uint8_t {
        line,   ///< straight
        cubic,  ///< a cubic Bézier curve
        arc,    ///< of an ellipse, at most half of it
    };
    Kind kind = Kind::line;  ///< which of the members below count
    Vector2 to = {};         ///< where it ends
    Vector2 control_1;       ///< cubic: the inner control point nearer to where it begins
    Vector2 control_2;       ///< cubic: the inner control point nearer to where it ends
    /// Elliptic arc: point(s) = centre + cos(s) apex + sin(s) along for s from -half_sweep to
    /// half_sweep, with the centre at the middle of the end points less cos(half_sweep) apex. Kept
    /// so, and not by its centre, a short arc of a huge circle loses no digits.
    Vector2 apex = {};        ///< from the centre to the middle of the arc
    Vector2 along = {};       ///< the other conjugate half diameter, in the direction of travel
    double half_sweep = 0.0;  ///< radians, above 0, at most pi
};

/// One closed outline. Where the last segment does not end at the start, a straight one closes it.
struct CurveContour {
    Vector2 start = {};                  ///< where the first segment begins
    std::vector<CurveSegment> segments;  ///< each from where the one before it ends
};

/// How an elliptic arc goes from one point to another, as SVG has it.
struct EllipticArc {
    double radius_x = 0.0;  ///< half axes; signs do not matter; 0: a straight line
    double radius_y = 0.0;  ///< likewise, along its own y axis
    double rotation = 0.0;  ///< of the ellipse's own x axis, radians, counter-clockwise
    bool large = false;     ///< of the four arcs there are, one of the two longer than half a turn
    bool counter_clockwise = true;  ///< from the x axis towards the y axis
};

/// Outlines made of straight lines, Bézier curves, elliptic arcs and splines, in the shape's own
/// coordinates. All contours together are one shape, filled by the odd-even rule like rings.
///
/// Whatever cannot be used (a segment before the first point, a number that is not finite) is
/// remembered and named by tessellate(). Not thread-safe; different paths are independent.
class NEARFIELD_EXPORT CurvePath {
public:
    /// Begins a contour; the one before it is closed.
    CurvePath& move_to(Vector2 start);
    /// A straight line from where the path is.
    CurvePath& line_to(Vector2 to);
    /// A quadratic Bézier curve from where the path is.
    CurvePath& quadratic_to(Vector2 control, Vector2 to);
    /// A cubic Bézier curve from where the path is.
    CurvePath& cubic_to(Vector2 control_1, Vector2 control_2, Vector2 to);

    /// An arc of an ellipse in end-point form. An ellipse too small to reach is scaled up until it
    /// does, as SVG has it; an arc to where it begins is left out.
    CurvePath& arc_to(const EllipticArc& arc, Vector2 to);
    /// An arc of a circle in centre form: turns about `centre` by `sweep` radians,
    /// counter-clockwise where positive, at most a whole turn either way.
    CurvePath& arc_about(Vector2 centre, double sweep);

    /// Ends the contour where it began. What follows without a move_to() begins there.
    CurvePath& close();

    /// A contour of its own: a whole circle, counter-clockwise.
    CurvePath& circle(Vector2 centre, double radius);
    /// A contour of its own: a whole ellipse, counter-clockwise. Radii are half axes; its x axis is
    /// turned by `rotation` radians, counter-clockwise.
    CurvePath& ellipse(Vector2 centre, double radius_x, double radius_y, double rotation = 0.0);
    /// A contour of its own: the closed centripetal Catmull-Rom spline through the points.
    /// (Centripetal: between neighbouring points it makes neither cusps nor loops.) Points that
    /// repeat the one before them are left out; three have to be left.
    CurvePath& catmull_rom(std::span<const Vector2> points);

    /// Adds all contours of another path.
    CurvePath& append(const CurvePath& other);
    /// Maps everything there is so far. Curves stay what they are: a circle becomes an ellipse.
    CurvePath& transform(const AffineMap& map);

    /// All contours there are so far. Borrowed until the path changes.
    [[nodiscard]] std::span<const CurveContour> contours() const noexcept { return contours_; }
    /// What could not be used first, empty where there is nothing of the kind.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

private:
    [[nodiscard]] Vector2 current() const;
    void add(const char* what, const CurveSegment& segment);
    void refuse(const char* what, const char* why);

    std::vector<CurveContour> contours_;
    bool open_ = false;  // the last contour takes further segments
    std::string problem_;
};

/// The rings of a path, one a contour (contours without segments are left out), in order. Every
/// vertex lies on the curve. No point of a contour is farther than `deviation` from its ring, and
/// no point of the ring farther than `deviation` from the contour: the Hausdorff distance, rounding
/// included. Nor does a point change sides that is farther than `deviation` from the ring. Give
/// Context::add_shape the same number and the bounds of all results hold for the curves.
///
/// Turning or moving a path turns or moves its rings, to rounding. Segments are as few as an equal
/// division needs for circles, and at most about twice as many as the fewest for the others, and a
/// few more at each point where a curve turns back (docs/error_budget.md has the derivation). A
/// contour with curves that would shrink to fewer than three vertices is divided further.
///
/// Errors: invalid_shape for a path that cannot be used (no contour, a number that is not finite or
/// beyond `largest_coordinate`, a segment before the first point, a deviation that is not above 0
/// or below what double precision resolves there); too_large where there would be more than `most`
/// vertices. Nothing is cut.
[[nodiscard]] NEARFIELD_EXPORT Expected<std::vector<Ring>> tessellate(
    const CurvePath& path, double deviation, std::uint32_t most = most_vertices);

}  // namespace nearfield
