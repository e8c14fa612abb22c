#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <iosfwd>

namespace nearfield::test {

struct Point {
    double x = 0.0;
    double y = 0.0;
};

/// How a test's message shows a point.
void PrintTo(const Point& point, std::ostream* stream);

[[nodiscard]] double distance(Point p, Point q);

/// A JSON array of two numbers; throws where it is none.
[[nodiscard]] Point to_point(const nlohmann::json& json);

/// An axis-aligned rectangle: everything about it is known without approximation.
struct Rectangle {
    Point min;
    Point max;

    /// Distance to the boundary, negative inside.
    [[nodiscard]] double signed_distance(Point p) const;
    /// Distance to the closed interior: 0 inside.
    [[nodiscard]] double outside_by(Point p) const;
    /// How far a point lies within the lowest, right, highest and left edge's line.
    [[nodiscard]] std::array<double, 4> depth_below_edges(Point p) const;
    /// The point at a share (0 to 1) of the way along edge 0, 1, 2 or 3.
    [[nodiscard]] Point on_edge(std::size_t edge, double share) const;
};

[[nodiscard]] Rectangle unit_square_at(Point corner);

}  // namespace nearfield::test
