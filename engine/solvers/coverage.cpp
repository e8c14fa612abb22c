#include <engine/solvers/coverage.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace nearfield::solvers {

using geometry::Vector;

namespace {

/// Integer division, rounded down for either sign of the numerator.
std::int64_t floor_of(std::int64_t numerator, std::int64_t denominator) {
    const std::int64_t quotient = numerator / denominator;
    return numerator % denominator < 0 ? quotient - 1 : quotient;
}

}  // namespace

std::uint64_t bits_between(std::uint32_t first, std::uint32_t end, std::uint32_t word) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    const std::uint32_t base = 64 * word;
    const std::uint32_t low = std::clamp(first, base, base + 64) - base;
    const std::uint32_t high = std::clamp(end, base, base + 64) - base;
    if (low >= high) {
        return 0;
    }
    return (high == 64 ? all : (std::uint64_t{1} << high) - 1) & (all << low);
}

void fill_from_crossings(std::span<std::uint64_t> row) {
    std::uint64_t odd = 0;  // all ones or zero
    for (std::size_t i = row.size(); i-- > 0;) {
        for (const std::uint32_t shift : {1U, 2U, 4U, 8U, 16U, 32U}) {
            row[i] ^= row[i] >> shift;
        }
        row[i] ^= odd;
        odd = 0 - (row[i] & 1);
    }
}

void Coverage::reset(std::uint32_t width, std::uint32_t height, geometry::SubpixelGrid grid) {
    width_ = width;
    height_ = height;
    steps_ = std::llround(grid.steps);
    shift_ = std::countr_zero(static_cast<std::uint64_t>(steps_));
    words_per_row_ = (width + 63) / 64;
    words_.assign(words_per_row_ * height, 0);
}

Coverage::GridPoint Coverage::to_grid(const Vector& point) const {
    const auto steps = static_cast<double>(steps_);
    return {static_cast<std::int64_t>(point.x() * steps),
            static_cast<std::int64_t>(point.y() * steps)};
}

std::int64_t Coverage::first_row_from(std::int64_t y) const {
    // Samples are at half cells: sample i is at (i + 1/2) * steps.
    const std::int64_t from_first = y - steps_ / 2;
    return std::clamp<std::int64_t>((from_first + steps_ - 1) >> shift_, 0, height_);
}

template <class Cross>
void Coverage::for_crossings(GridPoint low, GridPoint high, const Cross& cross) const {
    const std::int64_t first = first_row_from(low.y);
    const std::int64_t end = first_row_from(high.y);
    if (first >= end) {
        return;
    }
    // The edge crosses row r at x = low.x + (r * steps + half - low.y) * dx / dy, and the number of
    // samples left of it is (x - half) / steps, rounded up: a sample on the edge is not left of it.
    const std::int64_t half = steps_ / 2;
    const std::int64_t dx = high.x - low.x;
    const std::int64_t dy = high.y - low.y;
    const std::int64_t denominator = dy * steps_;
    const std::int64_t numerator =
        (low.x - half) * dy + (first * steps_ + half - low.y) * dx + denominator - 1;
    std::int64_t count = floor_of(numerator, denominator);
    std::int64_t rest = numerator - count * denominator;
    const std::int64_t step = end - first > 1 ? floor_of(dx, dy) : 0;
    const std::int64_t rest_step = (dx - step * dy) * steps_;
    for (std::int64_t row = first; row < end; ++row) {
        cross(static_cast<std::uint32_t>(row),
              static_cast<std::uint32_t>(std::clamp<std::int64_t>(count, 0, width_)));
        count += step;
        rest += rest_step;
        if (rest >= denominator) {
            rest -= denominator;
            ++count;
        }
    }
}

void Coverage::invert_left_of(const Vector& from, const Vector& to) {
    for_crossings(to_grid(from), to_grid(to), [this](std::uint32_t row, std::uint32_t count) {
        if (count > 0) {
            words_[row * words_per_row_ + (count - 1) / 64] ^= std::uint64_t{1}
                                                               << ((count - 1) % 64);
        }
    });
}

void Coverage::fill() {
    for (std::uint32_t row = 0; row < height_; ++row) {
        fill_from_crossings(std::span(words_).subspan(row * words_per_row_, words_per_row_));
    }
}

void Coverage::append_fan(const geometry::OffsetPolygon& polygon,
                          std::vector<RowSpan>& spans) const {
    std::array<GridPoint, std::tuple_size_v<geometry::OffsetPolygon>> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = to_grid(polygon[i]);
    }
    if (is_convex(corners)) {
        append_convex(corners, spans);
        return;
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
        append_convex(std::array{corners[0], corners[i - 1], corners[i]}, spans);
    }
}

bool Coverage::is_convex(std::span<const GridPoint> corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const GridPoint& a = corners[i];
        const GridPoint& b = corners[(i + 1) % corners.size()];
        const GridPoint& c = corners[(i + 2) % corners.size()];
        if ((b.x - a.x) * (c.y - b.y) <= (b.y - a.y) * (c.x - b.x)) {
            return false;
        }
    }
    return true;
}

void Coverage::append_convex(std::span<const GridPoint> corners,
                             std::vector<RowSpan>& spans) const {
    const auto [bottom, top] =
        std::minmax_element(corners.begin(), corners.end(),
                            [](const GridPoint& i, const GridPoint& j) { return i.y < j.y; });
    const auto first = static_cast<std::uint32_t>(first_row_from(bottom->y));
    const auto end = static_cast<std::uint32_t>(first_row_from(top->y));
    const std::size_t start = spans.size();
    for (std::uint32_t row = first; row < end; ++row) {
        spans.push_back({row, width_, 0});
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        GridPoint low = corners[i];
        GridPoint high = corners[(i + 1) % corners.size()];
        if (low.y > high.y) {
            std::swap(low, high);
        }
        // Two edges cross each row: the samples between them are covered.
        for_crossings(low, high, [&](std::uint32_t row, std::uint32_t count) {
            RowSpan& span = spans[start + row - first];
            span.first = std::min(span.first, count);
            span.end = std::max(span.end, count);
        });
    }
}

void Coverage::keep_common(const Coverage& other) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
        words_[i] &= other.words_[i];
    }
}

}  // namespace nearfield::solvers
