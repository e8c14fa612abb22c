#include <engine/geometry/hilbert_curve.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace nearfield::geometry {
namespace {

double cells_per_unit(double low, double high, std::uint32_t cells) {
    return high > low ? (cells - 1) / (high - low) : 0.0;
}

std::uint32_t cell_of(double from_low, double cells_per_unit, std::uint32_t cells) {
    return static_cast<std::uint32_t>(
        std::clamp(from_low * cells_per_unit, 0.0, static_cast<double>(cells - 1)));
}

/// So many halvings are looked up at once, in a table of the cells of a square of this side.
constexpr std::uint32_t halvings_at_once = 4;
constexpr std::uint32_t table_side = 1U << halvings_at_once;

/// What a cell of the square is on a curve that is turned, one of four ways.
struct CurveStep {
    std::uint8_t position = 0;
    std::uint8_t turn = 0;  // of the curve within the cell
};

constexpr std::uint32_t is_swapped = 1;   // the columns are rows
constexpr std::uint32_t is_mirrored = 2;  // both are counted from the end, after that

constexpr CurveStep step_of(std::uint32_t column, std::uint32_t row, std::uint32_t turn) {
    std::uint32_t position = 0;
    for (std::uint32_t bit = table_side / 2; bit > 0; bit /= 2) {
        const bool swapped = (turn & is_swapped) != 0;
        const bool mirrored = (turn & is_mirrored) != 0;
        const std::uint32_t right = (((swapped ? row : column) & bit) != 0) != mirrored ? 1 : 0;
        const std::uint32_t upper = (((swapped ? column : row) & bit) != 0) != mirrored ? 1 : 0;
        position = 4 * position + ((3 * right) ^ upper);
        // In the lower half the curve is turned, and on its right mirrored too.
        turn ^= upper != 0 ? 0 : is_swapped | (right != 0 ? is_mirrored : 0);
    }
    return {static_cast<std::uint8_t>(position), static_cast<std::uint8_t>(turn)};
}

using CurveSteps = std::array<CurveStep, std::size_t{4} * table_side * table_side>;

constexpr CurveSteps step_table = [] {
    CurveSteps all{};
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        all[i] =
            step_of(i / table_side % table_side, i % table_side, i / (table_side * table_side));
    }
    return all;
}();

}  // namespace

HilbertCurve::HilbertCurve(const Extent& box, std::uint32_t halvings)
    : box_(box),
      halvings_(halvings),
      cells_(1U << halvings),
      cells_per_x_(cells_per_unit(box.low_x, box.high_x, cells_)),
      cells_per_y_(cells_per_unit(box.low_y, box.high_y, cells_)) {}

std::uint32_t HilbertCurve::at(double x, double y) const {
    const std::uint32_t column = cell_of(x - box_.low_x, cells_per_x_, cells_);
    const std::uint32_t row = cell_of(y - box_.low_y, cells_per_y_, cells_);
    std::uint32_t position = 0;
    std::uint32_t turn = 0;
    for (std::uint32_t shift = halvings_; shift > 0;) {
        shift -= halvings_at_once;
        const std::uint32_t cell =
            ((column >> shift) % table_side) * table_side + (row >> shift) % table_side;
        const CurveStep& step = step_table[turn * table_side * table_side + cell];
        position = position << (2 * halvings_at_once) | step.position;
        turn = step.turn;
    }
    return position;
}

std::span<const std::uint32_t> HilbertOrder::sort_positions() {
    order_.resize(positions_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    sort_by_byte(0);
    sort_by_byte(1);
    return order_;
}

/// One stable counting-sort pass: places with the same byte keep their order.
void HilbertOrder::sort_by_byte(std::uint32_t byte) {
    const auto byte_of = [&](std::uint32_t place) -> std::size_t {
        return std::uint32_t{positions_[place]} >> (8U * byte) & 0xffU;
    };
    std::array<std::uint32_t, 257> begin{};
    for (const std::uint32_t place : order_) {
        ++begin[byte_of(place) + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    others_.resize(order_.size());
    for (const std::uint32_t place : order_) {
        others_[begin[byte_of(place)]++] = place;
    }
    order_.swap(others_);
}

}  // namespace nearfield::geometry
