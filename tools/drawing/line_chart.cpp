#include <tools/drawing/line_chart.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace nearfield::tools {
namespace {

/// A range of whole decades that contains all values.
struct Decades {
    int low = std::numeric_limits<int>::max();
    int high = std::numeric_limits<int>::min();

    void include(double value) {
        low = std::min(low, static_cast<int>(std::floor(std::log10(value) + 1e-9)));
        high = std::max(high, static_cast<int>(std::ceil(std::log10(value) - 1e-9)));
    }
    [[nodiscard]] double part(double value) const {
        return (std::log10(value) - low) / std::max(1, high - low);
    }
};

/// A power of ten in common notation.
std::string power_name(int exponent) {
    if (exponent >= 0) {
        std::string name = "1";
        for (int i = 0; i < exponent; ++i) {
            name += (exponent - i) % 3 == 0 && i > 0 ? ",0" : "0";
        }
        return exponent % 3 == 0 && exponent > 0 ? "1," + name.substr(1) : name;
    }
    return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + "1";
}

/// The axes of a chart, and the mapping of values to the page.
struct Axes {
    Rectangle page;
    Decades x;
    Decades y;

    [[nodiscard]] Vector2 place(Vector2 value) const {
        return {std::lerp(page.min.x, page.max.x, x.part(value.x)),
                std::lerp(page.max.y, page.min.y, y.part(value.y))};
    }
};

void stroke_line(Canvas& canvas, Vector2 from, Vector2 to, const Pen& pen) {
    const std::vector<Vector2> line{from, to};
    canvas.stroke_open(std::span(&line, 1), pen);
}

void draw_axes(Canvas& canvas, const Axes& axes, const LineChart& chart) {
    constexpr double size = 12.0;
    const Pen grid{palette::frame, 1.0};
    canvas.fill(axes.page, palette::panel);
    for (int decade = axes.x.low; decade <= axes.x.high; ++decade) {
        const double x = axes.place({std::pow(10.0, decade), 1.0}).x;
        stroke_line(canvas, {x, axes.page.min.y}, {x, axes.page.max.y}, grid);
        canvas.text({x, axes.page.max.y + 18.0}, power_name(decade), size, palette::quiet_text,
                    Align::center);
    }
    for (int decade = axes.y.low; decade <= axes.y.high; ++decade) {
        const double y = axes.place({1.0, std::pow(10.0, decade)}).y;
        stroke_line(canvas, {axes.page.min.x, y}, {axes.page.max.x, y}, grid);
        canvas.text({axes.page.min.x - 8.0, y + 4.0}, power_name(decade), size, palette::quiet_text,
                    Align::right);
    }
    canvas.text({axes.page.min.x, axes.page.min.y - 28.0}, chart.title, 15.0, palette::text,
                Align::left, Weight::bold);
    canvas.text({axes.page.min.x, axes.page.min.y - 10.0}, chart.y_name, size, palette::quiet_text);
    canvas.text({axes.page.max.x, axes.page.max.y + 36.0}, chart.x_name, size, palette::quiet_text,
                Align::right);
}

}  // namespace

void draw_line_chart(Canvas& canvas, const LineChart& chart, const Rectangle& page) {
    Axes axes{
        {{page.min.x + 70.0, page.min.y + 50.0}, {page.max.x - 110.0, page.max.y - 50.0}}, {}, {}};
    for (const ChartLine& line : chart.lines) {
        for (const Vector2& point : line.points) {
            axes.x.include(point.x);
            axes.y.include(point.y);
        }
    }
    draw_axes(canvas, axes, chart);
    double last_name = -1e9;  // names stand at the ends of the lines and must not overlap
    std::vector<const ChartLine*> by_end;
    for (const ChartLine& line : chart.lines) {
        if (!line.points.empty()) {
            by_end.push_back(&line);
        }
    }
    std::sort(by_end.begin(), by_end.end(), [](const ChartLine* a, const ChartLine* b) {
        return a->points.back().y > b->points.back().y;
    });
    for (const ChartLine* line : by_end) {
        std::vector<Vector2> points;
        points.reserve(line->points.size());
        for (const Vector2& point : line->points) {
            points.push_back(axes.place(point));
        }
        canvas.stroke_open(std::span(&points, 1), {line->color, 2.0});
        for (const Vector2& point : points) {
            canvas.dot(point, 3.0, line->color);
        }
        last_name = std::max(points.back().y + 4.0, last_name + 15.0);
        canvas.text({points.back().x + 9.0, last_name}, line->name, 13.0, line->color);
    }
}

}  // namespace nearfield::tools
