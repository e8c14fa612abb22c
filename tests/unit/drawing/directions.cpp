#include <gtest/gtest.h>
#include <tools/drawing/canvas.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/drawing/line_chart.hpp>
#include <tools/drawing/view.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::tools {
namespace {

constexpr Color white{1.0, 1.0, 1.0};

/// The mean place of the pixels that are nearly of a colour, and their number.
struct Marks {
    Vector2 mean{};
    double count = 0.0;
};

/// Looks at `rows` of the page, from the first to before the second, and likewise `columns`.
template <class Wanted>
Marks marks_in(const Canvas& canvas, int width, std::array<int, 2> columns, std::array<int, 2> rows,
               const Wanted& is_wanted) {
    const std::vector<std::uint32_t> pixels = canvas.pixels();
    Marks marks;
    for (int y = rows[0]; y < rows[1]; ++y) {
        for (int x = columns[0]; x < columns[1]; ++x) {
            if (is_wanted(pixels[static_cast<std::size_t>(y * width + x)])) {
                marks.mean.x += x;
                marks.mean.y += y;
                ++marks.count;
            }
        }
    }
    marks.mean.x /= std::max(marks.count, 1.0);
    marks.mean.y /= std::max(marks.count, 1.0);
    return marks;
}

bool is_drawn(std::uint32_t pixel) {
    return pixel != 0xffffffffU;
}

bool is_red(std::uint32_t pixel) {
    return (pixel >> 16U & 0xffU) > 200 && (pixel >> 8U & 0xffU) < 60 && (pixel & 0xffU) < 60;
}

TEST(ToolsDirections, AnArrowHasItsHeadWhereTheGradientPoints) {
    constexpr int side = 80;
    const auto drawn = [](Vector2 direction, std::array<int, 2> columns, std::array<int, 2> rows) {
        Canvas canvas(side, side, white);
        draw_gradient_arrow(canvas, {side / 2, side / 2}, direction);
        return marks_in(canvas, side, columns, rows, is_drawn).count;
    };
    constexpr std::array<int, 2> all{0, side};
    constexpr std::array<int, 2> low{0, side / 2};
    constexpr std::array<int, 2> high{side / 2, side};
    // The page's y points down, that of the world up.
    EXPECT_GT(drawn({0, 1}, all, low), 1.2 * drawn({0, 1}, all, high));
    EXPECT_GT(drawn({0, -1}, all, high), 1.2 * drawn({0, -1}, all, low));
    EXPECT_GT(drawn({1, 0}, high, all), 1.2 * drawn({1, 0}, low, all));
    EXPECT_GT(drawn({-1, 0}, low, all), 1.2 * drawn({-1, 0}, high, all));
}

TEST(ToolsDirections, AChartRisesToTheUpperRight) {
    constexpr int width = 600;
    constexpr int height = 400;
    Canvas canvas(width, height, white);
    draw_line_chart(canvas,
                    {"title", "x", "y", {{"", {1.0, 0.0, 0.0}, {{1, 1}, {10, 10}, {100, 100}}}}},
                    {{0, 0}, {width, height}});
    const Marks left = marks_in(canvas, width, {0, 250}, {0, height}, is_red);
    const Marks right = marks_in(canvas, width, {250, width}, {0, height}, is_red);
    ASSERT_GT(left.count, 50.0);
    ASSERT_GT(right.count, 50.0);
    EXPECT_GT(left.mean.y, right.mean.y + 50.0);
}

/// Lines of a cell whose corners are 1 and 1 on one diagonal, `low` and `low` on the other.
std::vector<std::vector<Vector2>> saddle(bool first_is_high, float low) {
    const float first = first_is_high ? 1.0F : low;
    const float second = first_is_high ? low : 1.0F;
    return contour_lines({2, 2, {first, second, second, first}}, 0.0);
}

TEST(ToolsDirections, ASaddleIsCutAsTheValueAtItsCentreSays) {
    const auto cuts_off = [](const std::vector<Vector2>& line, Vector2 corner) {
        return std::all_of(line.begin(), line.end(), [&](const Vector2& point) {
            return std::abs(point.x - corner.x) + std::abs(point.y - corner.y) < 1.0;
        });
    };
    for (const bool first_is_high : {false, true}) {
        for (const bool centre_is_high : {false, true}) {
            // Where the centre is high, the two low corners are cut off; else the two high ones.
            const bool is_first = first_is_high != centre_is_high;
            const std::vector<Vector2> corners = is_first ? std::vector<Vector2>{{0, 0}, {1, 1}}
                                                          : std::vector<Vector2>{{1, 0}, {0, 1}};
            const auto lines = saddle(first_is_high, centre_is_high ? -0.5F : -2.0F);
            ASSERT_EQ(lines.size(), 2U);
            for (const Vector2& corner : corners) {
                EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                                        [&](const auto& line) { return cuts_off(line, corner); }),
                          1)
                    << first_is_high << centre_is_high;
            }
        }
    }
}

TEST(ToolsDirections, RoundStepsContainTheirLimits) {
    for (const double step : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
        EXPECT_EQ(round_step(step, 1.0), step);
        EXPECT_LT(round_step(step * 0.999, 1.0), step);
        EXPECT_EQ(round_step(step * 1.001, 1.0), step);
    }
}

}  // namespace
}  // namespace nearfield::tools
