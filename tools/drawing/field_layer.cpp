#include <tools/drawing/cell_image.hpp>
#include <tools/drawing/color.hpp>
#include <tools/drawing/field_layer.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nearfield::tools {
namespace {

constexpr double iso_lattice_step = 2.0;  // pixels; small enough for smooth lines

}  // namespace

double FieldScale::position(double value) const {
    return value / std::max({-lowest, highest, 1e-300});
}

FieldLayer::FieldLayer(const DistanceFieldResult& field, const View& view)
    : field_(field), view_(view), page_(covered_page(field, view)) {
    const Lattice lattice = sample(iso_lattice_step);
    const auto [lowest, highest] =
        std::minmax_element(lattice.values.begin(), lattice.values.end());
    scale_.lowest = static_cast<double>(*lowest);
    scale_.highest = static_cast<double>(*highest);
    constexpr double wanted_lines = 14.0;
    scale_.iso_step = round_step(std::max(scale_.highest - scale_.lowest, 1e-300), wanted_lines);
}

double FieldLayer::value_at(Vector2 world) const {
    // Bilinear between cell centres, constant beyond the outermost ones.
    const double column = std::clamp((world.x - field_.origin.x) / field_.cell - 0.5, 0.0,
                                     static_cast<double>(field_.width - 1));
    const double row = std::clamp((world.y - field_.origin.y) / field_.cell - 0.5, 0.0,
                                  static_cast<double>(field_.height - 1));
    const auto left = static_cast<std::size_t>(column);
    const auto low = static_cast<std::size_t>(row);
    const std::size_t right = std::min<std::size_t>(left + 1, field_.width - 1);
    const std::size_t high = std::min<std::size_t>(low + 1, field_.height - 1);
    const auto value = [this](std::size_t x, std::size_t y) {
        return static_cast<double>(field_.values[y * field_.width + x]);
    };
    const double across = column - static_cast<double>(left);
    return std::lerp(std::lerp(value(left, low), value(right, low), across),
                     std::lerp(value(left, high), value(right, high), across),
                     row - static_cast<double>(low));
}

Lattice FieldLayer::sample(double step) const {
    Lattice lattice;
    const auto nodes = [step](double length) {
        return static_cast<std::size_t>(std::max(length, 0.0) / step) + 1;
    };
    lattice.width = nodes(page_.max.x - page_.min.x);
    lattice.height = nodes(page_.max.y - page_.min.y);
    lattice.values.reserve(lattice.width * lattice.height);
    for (std::size_t row = 0; row < lattice.height; ++row) {
        for (std::size_t column = 0; column < lattice.width; ++column) {
            const Vector2 page{page_.min.x + step * static_cast<double>(column),
                               page_.min.y + step * static_cast<double>(row)};
            lattice.values.push_back(static_cast<float>(value_at(view_.to_world(page))));
        }
    }
    return lattice;
}

void FieldLayer::draw_colors(Canvas& canvas) const {
    const Lattice lattice = sample(1.0);
    std::vector<std::uint32_t> table(1024);
    const double last = static_cast<double>(table.size() - 1);
    for (std::size_t index = 0; index < table.size(); ++index) {
        table[index] = pixel_of(diverging_color(2.0 * static_cast<double>(index) / last - 1.0));
    }
    std::vector<std::uint32_t> pixels;
    pixels.reserve(lattice.values.size());
    for (const float value : lattice.values) {
        const double position = std::clamp(scale_.position(static_cast<double>(value)), -1.0, 1.0);
        pixels.push_back(
            table[static_cast<std::size_t>(std::lround((position + 1.0) / 2.0 * last))]);
    }
    canvas.image(pixels, static_cast<int>(lattice.width), static_cast<int>(lattice.height),
                 page_.min);
}

std::vector<std::vector<Vector2>> FieldLayer::lines_at(const Lattice& lattice, double level) const {
    std::vector<std::vector<Vector2>> lines = contour_lines(lattice, level);
    for (std::vector<Vector2>& line : lines) {
        for (Vector2& point : line) {
            point = {page_.min.x + iso_lattice_step * point.x,
                     page_.min.y + iso_lattice_step * point.y};
        }
    }
    return lines;
}

void FieldLayer::draw_iso_lines(Canvas& canvas) const {
    const Lattice lattice = sample(iso_lattice_step);
    const auto first = std::lround(std::ceil(scale_.lowest / scale_.iso_step));
    const auto last = std::lround(std::floor(scale_.highest / scale_.iso_step));
    for (auto index = first; index <= last; ++index) {
        if (index != 0) {
            const double level = static_cast<double>(index) * scale_.iso_step;
            canvas.stroke_open(lines_at(lattice, level), {palette::text.with_alpha(0.32), 1.1});
        }
    }
    canvas.stroke_open(lines_at(lattice, 0.0), {palette::shape_b.with_alpha(0.8), 2.4});
}

}  // namespace nearfield::tools
