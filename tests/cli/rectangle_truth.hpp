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

/// Prints a point in a test's message.
void PrintTo(const Point& point, std::ostream* stream);

[[nodiscard]] double distance(Point p, Point q);

/// A JSON array of two numbers; throws for anything else.
[[nodiscard]] Point to_point(const nlohmann::json& json);

/// An axis-aligned rectangle, whose exact answers are known.
struct Rectangle {
    Point min;
    Point max;

    /// Distance to the boundary, negative inside.
    [[nodiscard]] double signed_distance(Point p) const;
    /// Distance to the closed interior: 0 inside.
    [[nodiscard]] double outside_by(Point p) const;
    /// The depth of a point below the line of the lowest, right, highest and left edge.
    [[nodiscard]] std::array<double, 4> depth_below_edges(Point p) const;
    /// The point at a fraction (0 to 1) of edge 0, 1, 2 or 3.
    [[nodiscard]] Point on_edge(std::size_t edge, double share) const;
};

[[nodiscard]] Rectangle unit_square_at(Point corner);

}  // namespace nearfield::test
