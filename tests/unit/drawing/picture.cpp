#include <gtest/gtest.h>
#include <tools/drawing/canvas.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/drawing/legend.hpp>
#include <tools/drawing/view.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

Lattice sampled(std::size_t side, double (*value)(double, double)) {
    Lattice lattice{side, side, {}};
    for (std::size_t row = 0; row < side; ++row) {
        for (std::size_t column = 0; column < side; ++column) {
            lattice.values.push_back(
                static_cast<float>(value(static_cast<double>(column), static_cast<double>(row))));
        }
    }
    return lattice;
}

TEST(ToolsContour, ADiskHasOneClosedLineOfItsRadius) {
    const Lattice lattice =
        sampled(41, [](double x, double y) { return std::hypot(x - 20.0, y - 20.0); });
    const auto lines = contour_lines(lattice, 12.3);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].front(), lines[0].back());
    for (const Vector2& point : lines[0]) {
        EXPECT_NEAR(std::hypot(point.x - 20.0, point.y - 20.0), 12.3, 0.02);
    }
}

TEST(ToolsContour, AStraightLineReachesBothBorders) {
    const Lattice lattice = sampled(10, [](double x, double y) { return x + 0.01 * y; });
    const auto lines = contour_lines(lattice, 4.5);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(std::abs(lines[0].front().y - lines[0].back().y), 9.0);
}

TEST(ToolsContour, EveryCrossingOfTheLatticeIsOnExactlyOneLine) {
    constexpr std::uint32_t seed = 7;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    Lattice lattice{30, 20, {}};
    for (std::size_t node = 0; node < 600; ++node) {
        lattice.values.push_back(uniform(random));
    }
    std::size_t crossings = 0;
    const auto above = [&](std::size_t x, std::size_t y) { return lattice.at(x, y) >= 0.0; };
    for (std::size_t y = 0; y < 20; ++y) {
        for (std::size_t x = 0; x < 30; ++x) {
            crossings += x + 1 < 30 && above(x, y) != above(x + 1, y) ? 1U : 0U;
            crossings += y + 1 < 20 && above(x, y) != above(x, y + 1) ? 1U : 0U;
        }
    }
    std::size_t found = 0;
    for (const auto& line : contour_lines(lattice, 0.0)) {
        const bool closed = line.front() == line.back();
        found += line.size() - (closed ? 1 : 0);
        const auto on_border = [](const Vector2& point) {
            return point.x == 0.0 || point.y == 0.0 || point.x == 29.0 || point.y == 19.0;
        };
        EXPECT_TRUE(closed || (on_border(line.front()) && on_border(line.back())));
    }
    EXPECT_EQ(found, crossings) << "seed " << seed;
}

TEST(ToolsView, GoesThereAndBackAndKeepsDistantVerticesOffThePage) {
    const View view({{1e6, -5}, {1e6 + 2, -4}}, {{100, 50}, {500, 250}});
    const Vector2 there = view.to_page(Vector2{1e6 + 0.25, -4.5});
    EXPECT_NEAR(view.to_world(there).x, 1e6 + 0.25, 1e-9);
    EXPECT_NEAR(view.to_world(there).y, -4.5, 1e-9);
    EXPECT_LT(view.to_page(Vector2{1e6, -4}).y, view.to_page(Vector2{1e6, -5}).y);
    for (const Vector2& point : view.to_page(Ring{{-1e9, -1e9}, {1e9, -1e9}, {1e6, 1e9}})) {
        EXPECT_LT(std::abs(point.x) + std::abs(point.y), 2000.0);
    }
}

TEST(ToolsColor, BothSidesGrowDarkerFromTheBoundary) {
    const auto luminance = [](double position) {
        const Color color = diverging_color(position);
        return 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
    };
    for (double position = 0.0; position < 1.0; position += 0.05) {
        EXPECT_GT(luminance(position), luminance(position + 0.05));
        EXPECT_GT(luminance(-position), luminance(-position - 0.05));
    }
    EXPECT_GT(diverging_color(-1.0).blue, diverging_color(-1.0).red);
    EXPECT_GT(diverging_color(1.0).red, diverging_color(1.0).blue);
}

TEST(ToolsColor, OverlapsAreRedAndClearancesTurnFromYellowToBlue) {
    for (const double position : {-1.5, -1.0, -0.5, -1e-9, 0.0}) {
        const Color color = clearance_color(position);
        EXPECT_GT(color.red, color.green + 0.3) << position;
        EXPECT_GT(color.red, color.blue + 0.3) << position;
    }
    EXPECT_GT(clearance_color(0.0).red, clearance_color(-1.0).red + 0.2) << "darker with the depth";
    const Color touching = clearance_color(1e-9);
    EXPECT_GT(touching.green, touching.blue + 0.3) << "yellow";
    const Color clear = clearance_color(1.0);
    EXPECT_GT(clear.blue, clear.red + 0.3);
    EXPECT_EQ(pixel_of(clearance_color(7.0)), pixel_of(clear));
}

TEST(ToolsCanvas, OutlinesOfATextAreWhereTheTextIs) {
    constexpr int width = 300;
    constexpr int height = 30;
    const std::string words = "d = 0.25 \u2212 80,000 %";
    Canvas written(width, height, rgb(0xFFFFFF));
    written.text({4.0, 20.0}, words, 17.0, rgb(0x000000));
    Canvas filled(width, height, rgb(0xFFFFFF));
    const auto outlines = filled.text_outlines({4.0, 20.0}, words, 17.0);
    EXPECT_EQ(outlines.size(), words.size() - 2) << "one for each character";
    for (const std::vector<Ring>& character : outlines) {
        filled.fill(character, rgb(0x000000));
    }
    // Text is hinted: no pixel of one is far from a pixel of the other.
    const std::vector<std::uint32_t> a = written.pixels();
    const std::vector<std::uint32_t> b = filled.pixels();
    const auto darkest_near = [](const std::vector<std::uint32_t>& pixels, int x, int y) {
        std::uint32_t least = 255;
        for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row) {
            for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column) {
                least =
                    std::min(least, pixels[static_cast<std::size_t>(row * width + column)] & 0xFFU);
            }
        }
        return least;
    };
    int dark = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto at = static_cast<std::size_t>(y * width + x);
            dark += (a[at] & 0xFFU) < 64U ? 1 : 0;
            if ((a[at] & 0xFFU) < 64U) {
                EXPECT_LT(darkest_near(b, x, y), 192U) << x << ' ' << y;
            }
            if ((b[at] & 0xFFU) < 64U) {
                EXPECT_LT(darkest_near(a, x, y), 192U) << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(dark, 200);
}

TEST(ToolsFurniture, ScaleNumbersHaveTheDigitsTheirStepNeeds) {
    EXPECT_EQ(scale_number(20.0, 5.0), "20");
    EXPECT_EQ(scale_number(-0.5, 0.25), "\u22120.5");
    EXPECT_EQ(scale_number(0.02, 0.02), "0.02");
    EXPECT_EQ(scale_number(0.0, 0.1), "0.0");
    EXPECT_EQ(round_step(10.0, 4.0), 2.0);
    EXPECT_EQ(round_step(0.9, 1.0), 0.5);
}

TEST(ToolsFigure, IsDrawnForEveryResultTheSameEachTime) {
    const FigureShape a{"a", {{{0, 0}, {4, 0}, {0, 3}}}};
    const FigureShape b{"b", {{{1, 1}, {5, 1}, {1, 4}}}};
    const Timings timings;
    const std::string device = "device";
    DistanceFieldResult field;
    field.cell = 1.0;
    field.width = 2;
    field.height = 2;
    field.values = {-1.0F, 0.0F, 0.0F, 1.0F};
    for (const AnyResult& result :
         {AnyResult(PenetrationResult{}), AnyResult(IntersectionResult{}), AnyResult(field)}) {
        QueryRequest request;
        request.type = static_cast<QueryType>(result.index());
        const Answer answer{request, result, timings, device};
        const std::string png = draw_figure({answer, a, b, result.index() == 1 ? nullptr : &field});
        EXPECT_EQ(png.substr(1, 3), "PNG");
        EXPECT_GT(png.size(), 10'000U);
        EXPECT_EQ(png, draw_figure({answer, a, b, result.index() == 1 ? nullptr : &field}));
    }
}

}  // namespace
}  // namespace nearfield::tools
