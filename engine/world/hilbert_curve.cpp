#include <engine/world/hilbert_curve.hpp>

#include <algorithm>
#include <limits>

namespace nearfield::world {
namespace {

constexpr double cells = 65535.0;

double cells_per_unit(double low, double high) {
    return high > low ? cells / (high - low) : 0.0;
}

std::uint32_t cell_of(double from_low, double cells_per_unit) {
    return static_cast<std::uint32_t>(std::clamp(from_low * cells_per_unit, 0.0, cells));
}

}  // namespace

HilbertCurve::HilbertCurve(const geometry::Extent& box)
    : box_(box),
      cells_per_x_(cells_per_unit(box.low_x, box.high_x)),
      cells_per_y_(cells_per_unit(box.low_y, box.high_y)) {}

std::uint32_t HilbertCurve::at(double x, double y) const {
    std::uint32_t column = cell_of(x - box_.low_x, cells_per_x_);
    std::uint32_t row = cell_of(y - box_.low_y, cells_per_y_);
    std::uint32_t position = 0;
    for (std::uint32_t side = 1U << 15U; side > 0; side /= 2) {
        const std::uint32_t right = (column & side) != 0 ? 1 : 0;
        const std::uint32_t upper = (row & side) != 0 ? 1 : 0;
        position += side * side * ((3 * right) ^ upper);
        if (upper == 0) {
            if (right == 1) {
                column = ~column;
                row = ~row;
            }
            std::swap(column, row);
        }
    }
    return position;
}

std::span<const std::pair<std::uint32_t, std::uint32_t>> HilbertOrder::sort(
    std::span<const Vector2> points) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    geometry::Extent box{infinity, infinity, -infinity, -infinity};
    for (const Vector2& point : points) {
        box = {std::min(box.low_x, point.x), std::min(box.low_y, point.y),
               std::max(box.high_x, point.x), std::max(box.high_y, point.y)};
    }
    const HilbertCurve curve(box);
    order_.clear();
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        order_.emplace_back(curve.at(points[i].x, points[i].y), i);
    }
    std::sort(order_.begin(), order_.end());
    return order_;
}

}  // namespace nearfield::world
