#pragma once

#include <cstdint>
#include <vector>

namespace nearfield::mtv::exact {

/// A point or a direction with integer coordinates.
struct Point {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// A polygon of one or more rings, inside by the even-odd rule.
using Shape = std::vector<std::vector<Point>>;

/// The translations of A after which two closed shapes share a point, computed exactly in integers.
/// Brute force: the shortest translation out of the set ends where it is perpendicular to a wall (a
/// vertex of one shape on an edge of the other), or where two walls cross. In every sector between
/// the walls through such a point the shapes share a point after all small steps or after none.
/// Coordinates up to about 1,000.
class Difference {
public:
    Difference(Shape a, Shape b);

    /// The infimum of the lengths of all translations after which the shapes share no point.
    [[nodiscard]] double shortest() const;

    /// True if the shapes share no point after a translation. Its coordinates are rounded to a
    /// multiple of 2^-50.
    [[nodiscard]] bool separates(double x, double y) const;

private:
    /// (x / w, y / w), w > 0.
    struct Rational {
        std::int64_t x = 0;
        std::int64_t y = 0;
        std::int64_t w = 1;
    };
    struct Edge {
        Point start;
        Point end;
    };

    [[nodiscard]] std::vector<Rational> ends() const;
    [[nodiscard]] std::vector<Point> sectors_at(const Rational& end) const;
    /// True if the shapes share a point after the translation and an infinitesimal step more.
    [[nodiscard]] bool share_a_point(const Rational& end, const Point& step) const;

    Shape a_;
    Shape b_;
    std::vector<Edge> edges_a_;
    std::vector<Edge> edges_b_;
    std::vector<Edge> walls_;
};

}  // namespace nearfield::mtv::exact
