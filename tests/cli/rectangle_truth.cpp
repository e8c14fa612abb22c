#include "rectangle_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <stdexcept>

namespace nearfield::test {

void PrintTo(const Point& point, std::ostream* stream) {
    *stream << point.x << ", " << point.y;
}

double distance(Point p, Point q) {
    return std::hypot(p.x - q.x, p.y - q.y);
}

Point to_point(const nlohmann::json& json) {
    const auto numbers = json.get<std::array<double, 2>>();
    if (json.size() != 2) {
        throw std::runtime_error("not two numbers: " + json.dump());
    }
    return {numbers[0], numbers[1]};
}

double Rectangle::outside_by(Point p) const {
    return std::hypot(std::max({min.x - p.x, p.x - max.x, 0.0}),
                      std::max({min.y - p.y, p.y - max.y, 0.0}));
}

std::array<double, 4> Rectangle::depth_below_edges(Point p) const {
    return {p.y - min.y, max.x - p.x, max.y - p.y, p.x - min.x};
}

double Rectangle::signed_distance(Point p) const {
    const std::array<double, 4> depths = depth_below_edges(p);
    const double least = *std::min_element(depths.begin(), depths.end());
    return least >= 0.0 ? -least : outside_by(p);
}

Point Rectangle::on_edge(std::size_t edge, double share) const {
    const std::array<Point, 4> corners{min, {max.x, min.y}, max, {min.x, max.y}};
    const Point from = corners[edge];
    const Point to = corners[(edge + 1) % 4];
    return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
}

Rectangle unit_square_at(Point corner) {
    return {corner, {corner.x + 1.0, corner.y + 1.0}};
}

}  // namespace nearfield::test
