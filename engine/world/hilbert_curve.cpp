#include <engine/world/hilbert_curve.hpp>

#include <algorithm>
#include <array>
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

/// So many halvings are looked up at once, in a table of the cells of a square of this side.
constexpr std::uint32_t halvings_at_once = 4;
constexpr std::uint32_t side = 1U << halvings_at_once;

/// What a cell of the square is on a curve that is turned, one of four ways.
struct Step {
    std::uint8_t position = 0;
    std::uint8_t turn = 0;  // of the curve within the cell
};

constexpr std::uint32_t is_swapped = 1;   // the columns are rows
constexpr std::uint32_t is_mirrored = 2;  // both are counted from the end, after that

constexpr Step step_of(std::uint32_t column, std::uint32_t row, std::uint32_t turn) {
    std::uint32_t position = 0;
    for (std::uint32_t bit = side / 2; bit > 0; bit /= 2) {
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

using Steps = std::array<Step, std::size_t{4} * side * side>;

constexpr Steps steps = [] {
    Steps all{};
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        all[i] = step_of(i / side % side, i % side, i / (side * side));
    }
    return all;
}();

}  // namespace

HilbertCurve::HilbertCurve(const geometry::Extent& box, std::uint32_t halvings)
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
        const std::uint32_t cell = ((column >> shift) % side) * side + (row >> shift) % side;
        const Step& step = steps[turn * side * side + cell];
        position = position << (2 * halvings_at_once) | step.position;
        turn = step.turn;
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
