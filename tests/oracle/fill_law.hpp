#pragma once

#include <nearfield/fill.hpp>
#include <nearfield/shape.hpp>

#include <tests/oracle/shape_oracle.hpp>
#include <tests/unit/support/winding_oracle.hpp>

#include <functional>
#include <span>
#include <vector>

namespace nearfield::oracle {

/// What a distance is measured from: a point or a shape.
struct Measured {
    std::vector<Vector2> corners;
    /// The distance to a point, 0 or less for those inside.
    std::function<double(const Vector2&)> distance;
};

/// The law of resolve_fill() for distances. The region that it finds has all points of the asked
/// region that are farther than the deviation from its boundary, and only points that are no
/// farther than that from it, so a distance to it lies between those to the asked region grown by
/// the deviation and shrunk by it. The same holds for what is outside.
///
/// Decided in whole numbers. That something is near is proven by a point of the asked region;
/// that nothing is nearer is disproven by a point: along all edges those are looked at that are a
/// deviation beside them, most of them near ends and crossings.
class FillLaw {
public:
    /// `resolved` is what the library made of the rings, coordinates of which are multiples of
    /// `unit`. Of FillRule::union_of_parts every ring is a part.
    FillLaw(std::span<const Ring> rings, double unit, FillRule rule, const ResolvedFill& resolved);

    /// False if the distance to the inside (`side` 1) or to the outside (0) cannot be `answered`
    /// (>= 0), which may be off by `bound`.
    [[nodiscard]] bool allows(const Measured& from, double answered, double bound, int side) const;
    /// The same for a point and a signed distance, negative inside.
    [[nodiscard]] bool allows(const Vector2& from, double answered, double bound) const;
    /// True if both the inside and the outside are within the deviation of a point.
    [[nodiscard]] bool is_on_boundary(const Vector2& point) const;
    /// True if a point of a side was found within a distance and the deviation.
    [[nodiscard]] bool is_near(const Measured& from, double distance, int side) const;
    /// True if a point of a side was found within a distance that is farther than the deviation
    /// from all edges.
    [[nodiscard]] bool is_clearly_near(const Measured& from, double distance, int side) const;

private:
    struct Line {
        Vector2 from;
        Vector2 way;
        double length;
    };

    [[nodiscard]] test::WholePlace placed(const Vector2& point) const;
    [[nodiscard]] bool is_clear(const Vector2& point, int side) const;
    [[nodiscard]] std::vector<double> parts_to_look_at(const Line& line,
                                                       const Measured& from) const;

    double unit_;
    double radius_;  // the deviation, in units
    test::WindingOracle asked_;
    std::vector<Line> lines_;
    ShapeOracle resolved_;
};

}  // namespace nearfield::oracle
