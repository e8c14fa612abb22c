#include <gtest/gtest.h>
#include <tools/io/svg_values.hpp>

#include <string>

namespace nearfield::tools {
namespace {

std::vector<Ring> rings_of(const CurvePath& path) {
    return *tessellate(path, 0.01);
}

void expect_path(const std::string& data, const CurvePath& expected) {
    const std::string file = "a.path";
    SvgText text(data, 0, data, file);
    EXPECT_EQ(rings_of(parse_path_data(text)), rings_of(expected)) << data;
}

// SVG 1.1, 8.3.6 and 8.3.7: a smooth command reflects the control point of a command of its own
// degree alone; after any other, the control point is the current point.

TEST(ToolsSvgSmoothCurves, SReflectsNoControlPointOfQOrT) {
    const CurvePath arch = CurvePath().move_to({1, 1}).quadratic_to({2, 4}, {3, 1});
    expect_path("M1 1Q2 4 3 1S6 4 7 1", CurvePath(arch).cubic_to({3, 1}, {6, 4}, {7, 1}));
    expect_path("M1 1q1 3 2 0s3 3 4 0", CurvePath(arch).cubic_to({3, 1}, {6, 4}, {7, 1}));
    expect_path("M1 1Q2 4 3 1T5 1S6 4 7 1",
                CurvePath(arch).quadratic_to({4, -2}, {5, 1}).cubic_to({5, 1}, {6, 4}, {7, 1}));
}

TEST(ToolsSvgSmoothCurves, TReflectsNoControlPointOfCOrS) {
    const CurvePath arch = CurvePath().move_to({1, 1}).cubic_to({1, 4}, {3, 4}, {3, 1});
    // A quadratic curve with its control point at its start is a straight line.
    expect_path("M1 1C1 4 3 4 3 1T7 2", CurvePath(arch).quadratic_to({3, 1}, {7, 2}));
    expect_path("M1 1C1 4 3 4 3 1S6 4 7 1T9 3",
                CurvePath(arch).cubic_to({3, -2}, {6, 4}, {7, 1}).quadratic_to({7, 1}, {9, 3}));
    // The T after that reflects the control point that the first T took.
    expect_path("M1 1C1 4 3 4 3 1T7 2T9 4",
                CurvePath(arch).quadratic_to({3, 1}, {7, 2}).quadratic_to({11, 3}, {9, 4}));
}

TEST(ToolsSvgSmoothCurves, NothingIsReflectedAcrossAnythingElse) {
    const CurvePath arch = CurvePath().move_to({1, 1}).cubic_to({1, 4}, {3, 4}, {3, 1});
    expect_path("M1 1C1 4 3 4 3 1H5S8 4 9 1",
                CurvePath(arch).line_to({5, 1}).cubic_to({5, 1}, {8, 4}, {9, 1}));
    expect_path(
        "M1 1C1 4 3 4 3 1A2 2 0 0 0 5 1S8 4 9 1",
        CurvePath(arch).arc_to({2, 2, 0, false, false}, {5, 1}).cubic_to({5, 1}, {8, 4}, {9, 1}));
    expect_path("M1 1C1 4 3 4 3 1zS8 4 9 1",
                CurvePath(arch).close().move_to({1, 1}).cubic_to({1, 1}, {8, 4}, {9, 1}));
    const CurvePath low = CurvePath().move_to({1, 1}).quadratic_to({2, 4}, {3, 1});
    expect_path("M1 1Q2 4 3 1V3T9 4", CurvePath(low).line_to({3, 3}).quadratic_to({3, 3}, {9, 4}));
    expect_path(
        "M1 1Q2 4 3 1M5 5T9 4T3 9",
        CurvePath(low).move_to({5, 5}).quadratic_to({5, 5}, {9, 4}).quadratic_to({13, 3}, {3, 9}));
}

}  // namespace
}  // namespace nearfield::tools
