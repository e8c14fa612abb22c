#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/shape_rings.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

ShapeRings drawn(const std::string& content, const OutlineTreatment& treatment = {}) {
    return make_shape_rings(parse_outline({"a.svg", "<svg>" + content + "</svg>"}), 0.01,
                            treatment);
}

double area(const std::vector<Ring>& rings) {
    double twice = 0.0;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& a = ring[i];
            const Vector2& b = ring[(i + 1) % ring.size()];
            twice += a.x * b.y - a.y * b.x;
        }
    }
    return std::abs(twice) / 2.0;
}

// Two squares that overlap in one of side 2: together 28, with the common part left out 24.
constexpr const char* both = "M0 0h4v4h-4z M2 2h4v4h-4z";

TEST(ToolsDrawnRings, FollowTheFillRulesOfTheElements) {
    const std::string path = std::string("<path d='") + both + "'";
    EXPECT_NEAR(area(drawn(path + "/>").rings), 28.0, 1e-9);
    EXPECT_EQ(drawn(path + " fill-rule='evenodd'/>").rings.size(), 2U);
    EXPECT_EQ(drawn(path + " fill-rule='evenodd'/>").deviation, 0.0);
    // Elements cover each other.
    EXPECT_NEAR(
        area(drawn("<rect width='4' height='4'/><rect x='2' y='2' width='4' height='4'/>").rings),
        28.0, 1e-9);
    // The hole of an element stays, unless another one covers it.
    const std::string frame = "<path fill-rule='evenodd' d='M0 0h6v6h-6z M1 1v4h4v-4z'/>";
    EXPECT_NEAR(area(drawn(frame + "<rect x='2' y='2' width='1' height='1'/>").rings), 21.0, 1e-9);
    EXPECT_NEAR(area(drawn(frame + "<rect x='0' y='0' width='3' height='6'/>").rings), 28.0, 1e-9);
    // An option is the rule of all rings together.
    EXPECT_NEAR(area(drawn(frame + path + "/>", {.fill_rule = FillRule::nonzero}).rings), 34.0,
                1e-9);
}

TEST(ToolsDrawnRings, StayAsTheyAreWhereNothingIsInside) {
    const ShapeRings rings = drawn("<path d='M0 0h4v3z'/><rect x='9' width='1' height='1'/>");
    EXPECT_EQ(rings.rings,
              (std::vector<Ring>{{{0, 0}, {4, 0}, {4, -3}}, {{9, 0}, {10, 0}, {10, -1}, {9, -1}}}));
    EXPECT_GT(rings.deviation, 0.0);
    EXPECT_LT(rings.deviation, 1e-10);
    EXPECT_EQ(drawn("<circle r='3'/>").deviation, 0.01);
    // Side by side: the common edge is inside.
    EXPECT_EQ(drawn("<rect width='1' height='1'/><rect x='1' width='1' height='1'/>").rings.size(),
              1U);
}

TEST(ToolsDrawnRings, ReportWhatEnclosesNothing) {
    const std::string file = "<path d='M0 0h4v3z'/><polyline points='5 5 6 6'/>";
    const ShapeRings rings = drawn(file);
    EXPECT_EQ(rings.rings.size(), 1U);
    EXPECT_NE(rings.note.find("a.svg: dropped 1 of 2 rings that enclose nothing"),
              std::string::npos)
        << rings.note;
    EXPECT_NE(
        input_error([&] { return drawn(file, {.strict = true}); }).find("ring 1 from (5, -5)"),
        std::string::npos);
    EXPECT_EQ(input_error([&] { return drawn("<polyline points='5 5 6 6'/>"); }),
              "a.svg: nothing that is drawn encloses an area");
}

TEST(ToolsSameRings, AreFoundInAnyOrder) {
    const std::vector<Ring> rings{{{0, 0}, {4, 0}, {4, 3}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const std::vector<Ring> turned{{{1, 1}, {1, 0}, {0, 0}, {0, 1}}, {{4, 3.1}, {0, 0}, {4, 0}}};
    EXPECT_TRUE(are_same_rings(rings, turned, 0.11));
    EXPECT_FALSE(are_same_rings(rings, turned, 0.09));
    EXPECT_FALSE(are_same_rings(rings, std::vector<Ring>{rings[0]}, 1.0));
    EXPECT_FALSE(are_same_rings(rings, std::vector<Ring>{rings[0], rings[0]}, 1e-9));
    // One ring is not the match of two.
    EXPECT_FALSE(are_same_rings(std::vector<Ring>{rings[0], rings[0]}, rings, 1e-9));
    EXPECT_TRUE(are_same_rings(std::vector<Ring>(2, rings[0]), std::vector<Ring>(2, rings[0]), 0));
    std::vector<Ring> swapped = rings;
    std::swap(swapped[1][1], swapped[1][2]);
    EXPECT_FALSE(are_same_rings(rings, swapped, 0.5));
}

}  // namespace
}  // namespace nearfield::tools
