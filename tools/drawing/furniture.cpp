#include <tools/drawing/color.hpp>
#include <tools/drawing/furniture.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace nearfield::tools {
namespace {

constexpr double label_size = 21.0;

double middle(double a, double b) {
    return (a + b) / 2.0;
}

}  // namespace

std::string scale_number(double number, double step) {
    const double magnitude = std::max(std::abs(number), step);
    char text[48];
    if (magnitude >= 1e7 || step < 1e-4) {
        std::snprintf(text, sizeof text, "%.3g", std::abs(number));
    } else {
        const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
        std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(number));
    }
    return (number < 0.0 ? "\u2212" : "") + std::string(text);
}

void draw_color_bar(Canvas& canvas, const FieldScale& scale, const Rectangle& strip) {
    const double range = scale.highest - scale.lowest;
    if (!(range > 0.0)) {
        return;
    }
    const double height = strip.max.y - strip.min.y;
    const auto page_y = [&](double value) {
        return strip.max.y - (value - scale.lowest) / range * height;
    };
    for (int row = 0; row < height; ++row) {
        const double y = strip.min.y + row;
        const double value = scale.lowest + (strip.max.y - y - 0.5) / height * range;
        canvas.fill({{strip.min.x, y}, {strip.max.x, std::min(y + 1.0, strip.max.y)}},
                    diverging_color(scale.position(value)));
    }
    canvas.stroke(strip, {palette::frame, 1.5});
    const double step = round_step(range, 6.0);
    const auto first = std::lround(std::ceil(scale.lowest / step));
    const auto last = std::lround(std::floor(scale.highest / step));
    for (auto index = first; index <= last; ++index) {
        const double value = static_cast<double>(index) * step;
        const double y = page_y(value);
        const bool zero = index == 0;
        const std::vector<Vector2> tick{{zero ? strip.min.x : strip.max.x - 8.0, y},
                                        {strip.max.x, y}};
        canvas.stroke_open(std::span(&tick, 1),
                           {zero ? palette::shape_b : palette::text, zero ? 3.4 : 1.5});
        canvas.text({strip.max.x + 10.0, y + 0.36 * label_size},
                    zero ? "0" : scale_number(value, step), label_size, palette::text, Align::left,
                    zero ? Weight::bold : Weight::normal);
    }
}

void draw_scale_bar(Canvas& canvas, const View& view) {
    const Rectangle& page = view.page();
    const double longest = 0.22 * (page.max.x - page.min.x) / view.scale();
    const double length = round_step(longest, 1.0);
    const double pixels = length * view.scale();
    const std::string label = scale_number(length, length) + (length == 1.0 ? " unit" : " units");
    const double inner = std::max(pixels, canvas.text_width(label, label_size));
    const Vector2 corner{page.min.x + 18.0, page.max.y - 18.0};
    canvas.fill({{corner.x, corner.y - 58.0}, {corner.x + inner + 32.0, corner.y}},
                palette::page.with_alpha(0.86), 8.0);
    const double center = corner.x + 16.0 + inner / 2.0;
    const double left = center - pixels / 2.0;
    const double right = center + pixels / 2.0;
    const double y = corner.y - 16.0;
    const std::vector<std::vector<Vector2>> bar{{{left, y - 6.0}, {left, y + 3.0}},
                                                {{left, y}, {right, y}},
                                                {{right, y - 6.0}, {right, y + 3.0}}};
    canvas.stroke_open(bar, {palette::text, 2.4});
    canvas.text({center, y - 15.0}, label, label_size, palette::text, Align::center);
}

void draw_legend(Canvas& canvas, const std::vector<LegendEntry>& entries, const Rectangle& area) {
    constexpr double line_height = 43.0;
    constexpr double symbol_width = 52.0;
    constexpr double symbol_height = 24.0;
    double y = area.min.y;
    for (const LegendEntry& entry : entries) {
        const Rectangle symbol{{area.min.x, y}, {area.min.x + symbol_width, y + symbol_height}};
        entry.symbol(canvas, symbol);
        const double x = symbol.max.x + 18.0;
        canvas.text({x, middle(symbol.min.y, symbol.max.y) + 0.36 * label_size},
                    canvas.shortened(entry.text, label_size, area.max.x - x), label_size,
                    palette::text);
        y += line_height;
    }
}

}  // namespace nearfield::tools
