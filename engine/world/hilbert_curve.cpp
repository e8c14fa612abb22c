#include <engine/world/hilbert_curve.hpp>

#include <algorithm>
#include <numeric>

namespace nearfield::world {
namespace {

double cells_per_unit(double low, double high, std::uint32_t cells) {
    return high > low ? (cells - 1) / (high - low) : 0.0;
}

std::uint32_t cell_of(double from_low, double cells_per_unit, std::uint32_t cells) {
    return static_cast<std::uint32_t>(
        std::clamp(from_low * cells_per_unit, 0.0, static_cast<double>(cells - 1)));
}

}  // namespace

HilbertCurve::HilbertCurve(const geometry::Extent& box, std::uint32_t halvings)
    : box_(box),
      cells_(1U << halvings),
      cells_per_x_(cells_per_unit(box.low_x, box.high_x, cells_)),
      cells_per_y_(cells_per_unit(box.low_y, box.high_y, cells_)) {}

std::uint32_t HilbertCurve::at(double x, double y) const {
    std::uint32_t column = cell_of(x - box_.low_x, cells_per_x_, cells_);
    std::uint32_t row = cell_of(y - box_.low_y, cells_per_y_, cells_);
    std::uint32_t position = 0;
    for (std::uint32_t side = cells_ / 2; side > 0; side /= 2) {
        const std::uint32_t right = (column & side) != 0 ? 1 : 0;
        const std::uint32_t upper = (row & side) != 0 ? 1 : 0;
        position += side * side * ((3 * right) ^ upper);
        // Without branches, which nobody could predict. In the lower half the curve is turned, and
        // on its right mirrored too.
        const std::uint32_t turned = upper - 1U;
        const std::uint32_t mirrored = turned & (0U - right);
        const std::uint32_t swapped = (column ^ row) & turned;
        column ^= mirrored ^ swapped;
        row ^= mirrored ^ swapped;
    }
    return position;
}

std::span<const std::uint32_t> HilbertOrder::sort_positions() {
    begins_.assign((1U << (2 * halvings)) + 1, 0);
    for (const std::uint32_t position : positions_) {
        ++begins_[position + 1];
    }
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    order_.resize(positions_.size());
    for (std::uint32_t i = 0; i < positions_.size(); ++i) {
        order_[begins_[positions_[i]]++] = i;
    }
    return order_;
}

}  // namespace nearfield::world
