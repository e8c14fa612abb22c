#include "dxf_text.hpp"

#include <gtest/gtest.h>
#include <tools/io/dxf.hpp>
#include <tools/io/outline.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

/// Areas of the contours, positive counter-clockwise.
std::vector<double> areas(const CurvePath& path, double deviation = 1e-7) {
    const std::vector<Ring> rings = *tessellate(path, deviation);
    std::vector<double> found;
    for (const Ring& ring : rings) {
        double twice = 0.0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& a = ring[i];
            const Vector2& b = ring[(i + 1) % ring.size()];
            twice += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
        }
        found.push_back(0.5 * twice);
    }
    return found;
}

double area(const CurvePath& path) {
    const std::vector<double> found = areas(path);
    EXPECT_EQ(found.size(), 1U);
    return found.empty() ? 0.0 : found.front();
}

TEST(ToolsDxf, PolylinesWithBulges) {
    // A stadium: two half circles, of which a bulge of 1 is one.
    EXPECT_NEAR(
        area(read_drawing(drawing("0 LWPOLYLINE 90 4 70 1 43 0.5 10 0 20 0 10 4 20 0 42 1 10 4 20 "
                                  "2 10 0 20 2 42 1"))),
        8.0 + std::numbers::pi, 1e-5);
    // A quarter circle cut off; the bulge is negative clockwise.
    const double quarter = std::tan(std::numbers::pi / 8.0);
    EXPECT_NEAR(area(read_drawing(drawing("0 LWPOLYLINE 70 1 10 0 20 0 10 1 20 0 42 " +
                                          std::to_string(-quarter) + " 10 0 20 1"))),
                1.0 - std::numbers::pi / 4.0, 1e-5);
    EXPECT_NEAR(
        area(read_drawing(drawing("0 POLYLINE 66 1 70 1 10 0 20 0 30 0 0 VERTEX 10 0 20 0 42 1 0 "
                                  "VERTEX 10 2 20 0 42 1 0 SEQEND 8 0"))),
        std::numbers::pi, 1e-5);
    // Seen from behind, x points the other way.
    const CurvePath behind = read_drawing(
        drawing("0 LWPOLYLINE 70 1 230 -1 10 0 20 0 10 4 20 0 42 1 10 4 20 2 10 0 20 2"));
    EXPECT_NEAR(area(behind), -(8.0 + std::numbers::pi / 2.0), 1e-5);
    EXPECT_EQ(behind.contours()[0].segments[0].to, (Vector2{-4.0, 0.0}));
}

TEST(ToolsDxf, LinesAndArcsAreJoinedToLoops) {
    const std::string rounded = " 0 ARC 10 4 20 1 40 1 50 270 51 90" + line({4, 2}, {0, 2}) +
                                line({4, 0}, {0, 0}) + " 0 ARC 10 0 20 1 40 1 50 90 51 -90";
    EXPECT_NEAR(std::abs(area(read_drawing(drawing(rounded)))), 8.0 + std::numbers::pi, 1e-5);
    // A square of two open polylines, and a hole in it.
    const CurvePath holed = read_drawing(
        drawing("0 CIRCLE 10 1 20 1 40 0.5 0 LWPOLYLINE 10 0 20 0 10 2 20 0 10 2 20 2 0 POLYLINE "
                "70 0 0 VERTEX 10 0 20 0 0 VERTEX 10 0 20 2 0 VERTEX 10 2 20 2 0 SEQEND"));
    const std::vector<double> found = areas(holed);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0], std::numbers::pi / 4.0, 1e-5);
    EXPECT_NEAR(std::abs(found[1]), 4.0, 1e-12);
    EXPECT_NEAR(area(read_drawing(drawing("0 ARC 10 1 20 2 40 3 50 30 51 390"))),
                9.0 * std::numbers::pi, 1e-4);
    EXPECT_NEAR(
        area(read_drawing(drawing("0 ELLIPSE 10 1 20 2 11 0 21 3 40 0.5 41 0 42 6.283185307"))),
        4.5 * std::numbers::pi, 1e-4);
}

TEST(ToolsDxf, RandomLoopsInAnyOrder) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const auto number = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        const double scale = seed % 3 == 0 ? 1e6 : 1.0;
        CurvePath wanted;
        std::vector<std::string> pieces;
        for (int loop = 0; loop < 3; ++loop) {
            // A radial polygon with lines and arcs as sides.
            const int count = 3 + static_cast<int>(random() % 8);
            const Vector2 centre{scale * number(-9, 9), scale * number(-9, 9)};
            std::vector<Vector2> at;
            for (int i = 0; i < count; ++i) {
                const double angle = 2.0 * std::numbers::pi * i / count;
                const double radius = scale * number(1, 2);
                at.push_back(
                    {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
            }
            wanted.move_to(at[0]);
            for (std::size_t i = 0; i < at.size(); ++i) {
                const Vector2 to = at[(i + 1) % at.size()];
                const double bulge = random() % 2 == 0 ? 0.0 : number(-2.0, 2.0);
                const bool turned = random() % 2 == 0;
                // Ends are off by less than what is joined.
                const double off = 1e-7 * scale;
                const Vector2 a{at[i].x + number(-off, off), at[i].y};
                const Vector2 b{to.x, to.y + number(-off, off)};
                if (bulge == 0.0) {
                    wanted.line_to(to);
                    pieces.push_back(turned ? line(b, a) : line(a, b));
                    continue;
                }
                const double radius = 0.25 * std::hypot(to.x - at[i].x, to.y - at[i].y) *
                                      (1 / std::abs(bulge) + std::abs(bulge));
                wanted.arc_to({radius, radius, 0.0, std::abs(bulge) > 1.0, bulge > 0.0}, to);
                std::ostringstream text;
                text.precision(17);
                text << " 0 LWPOLYLINE 70 0 10 " << (turned ? b : a).x << " 20 "
                     << (turned ? b : a).y << " 42 " << (turned ? -bulge : bulge) << " 10 "
                     << (turned ? a : b).x << " 20 " << (turned ? a : b).y;
                pieces.push_back(text.str());
            }
            wanted.close();
        }
        std::shuffle(pieces.begin(), pieces.end(), random);
        std::string entities;
        for (const std::string& piece : pieces) {
            entities += piece;
        }
        const auto sorted = [&](const CurvePath& path) {
            std::vector<double> found = areas(path, 1e-4 * scale);
            for (double& one : found) {
                one = std::abs(one);
            }
            std::sort(found.begin(), found.end());
            return found;
        };
        const std::vector<double> expected = sorted(wanted);
        const std::vector<double> found = sorted(read_drawing(drawing(entities)));
        ASSERT_EQ(found.size(), expected.size()) << seed;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_NEAR(found[i], expected[i], 2e-3 * scale * scale) << seed;
        }
    }
}

TEST(ToolsDxf, BlocksAreInserted) {
    const std::string blocks = lines(
        "0 SECTION 2 BLOCKS "
        "0 BLOCK 2 square 10 1 20 1 0 LWPOLYLINE 70 1 10 1 20 1 10 3 20 1 10 3 20 2 10 1 20 2 "
        "0 ENDBLK "
        "0 BLOCK 2 pair 10 0 20 0 0 INSERT 2 square 10 0 20 0 0 INSERT 2 square 10 9 20 0 41 -1 "
        "0 ENDBLK 0 ENDSEC");
    const CurvePath turned =
        read_drawing(blocks + drawing("0 INSERT 2 square 10 5 20 6 41 2 42 3 50 90"));
    EXPECT_NEAR(area(turned), 12.0, 1e-9);
    // Base (1, 1) to (5, 6); (3, 1) is 2 * 2 along the turned x axis.
    EXPECT_NEAR(turned.contours()[0].segments[0].to.x, 5.0, 1e-12);
    EXPECT_NEAR(turned.contours()[0].segments[0].to.y, 10.0, 1e-12);
    EXPECT_EQ(areas(read_drawing(blocks + drawing("0 INSERT 2 pair 10 0 20 0"))),
              (std::vector<double>{2.0, -2.0}));
    const CurvePath behind = read_drawing(blocks + drawing("0 INSERT 2 square 10 5 20 6 230 -1"));
    EXPECT_EQ(behind.contours()[0].start, (Vector2{-5.0, 6.0}));
    EXPECT_EQ(behind.contours()[0].segments[0].to, (Vector2{-7.0, 6.0}));
}

TEST(ToolsDxf, UnitsAreTheHeaders) {
    const std::string inches = "0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 9 $INSUNITS 70 1 0 ENDSEC";
    const std::string circle = "0 CIRCLE 10 0 20 0 40 1";
    EXPECT_NEAR(area(read_drawing(drawing(circle, inches), LengthUnit::mm)),
                std::numbers::pi * 25.4 * 25.4, 0.01);
    EXPECT_NEAR(area(read_drawing(drawing(circle, inches))), std::numbers::pi, 1e-5);
    EXPECT_NE(refusal(drawing(circle), LengthUnit::mm).find("states no unit"), std::string::npos);
}

TEST(ToolsDxf, NotesWhatIsNoOutline) {
    SkippedParts skipped;
    static_cast<void>(
        parse_dxf(drawing("0 TEXT 1 hello 0 POINT 10 1 20 1 0 CIRCLE 10 0 20 0 40 1 0 "
                          "CIRCLE 67 1 10 0 20 0 40 5 0 TEXT 1 again"),
                  "a.dxf", skipped));
    EXPECT_EQ(skipped.text(), "TEXT (2), POINT (1), of paper space, or invisible (1)");
}

TEST(ToolsDxf, WhatHasNoSizeIsSkipped) {
    SkippedParts skipped;
    const CurvePath path = parse_dxf(
        drawing("0 CIRCLE 10 0 20 0 40 1 0 CIRCLE 10 3 20 0 40 0 0 ARC 10 3 20 0 40 0 50 0 "
                "51 90 0 LWPOLYLINE 70 1 10 1 20 1"),
        "a.dxf", skipped);
    EXPECT_EQ(path.contours().size(), 1U);
    EXPECT_EQ(skipped.text(), "empty part (3)");
}

TEST(ToolsDxf, LinesDrawnTwiceCountOnceWhereAnOutlineWouldStayOpen) {
    const std::string square =
        line({0, 0}, {1, 0}) + line({1, 0}, {1, 1}) + line({1, 1}, {0, 1}) + line({0, 1}, {0, 0});
    SkippedParts skipped;
    EXPECT_EQ(area(parse_dxf(drawing(square + line({1, 1}, {1, 0})), "a.dxf", skipped)), 1.0);
    EXPECT_EQ(skipped.text(), "line drawn twice (1)");
    // Two squares with a side in common have it twice.
    SkippedParts none;
    const CurvePath two = parse_dxf(drawing(square + line({1, 0}, {2, 0}) + line({2, 0}, {2, 1}) +
                                            line({2, 1}, {1, 1}) + line({1, 1}, {1, 0})),
                                    "a.dxf", none);
    EXPECT_TRUE(none.empty()) << none.text();
    double sum = 0.0;
    for (const double each : areas(two)) {
        sum += std::abs(each);
    }
    EXPECT_NEAR(sum, 2.0, 1e-9);
}

TEST(ToolsDxf, SlightBulgesAreNearlyStraight) {
    for (const double bulge : {1e-300, -1e-16, 1e-12, -1e-9, 9.9e-9, 1.01e-8}) {
        std::ostringstream text;
        text.precision(17);
        text << "0 LWPOLYLINE 70 1 10 0 20 0 42 " << bulge << " 10 10 20 0 10 10 20 10";
        // A positive bulge adds a segment of a circle below, 2/3 of chord and sagitta.
        EXPECT_NEAR(areas(read_drawing(drawing(text.str())), 1e-10)[0],
                    50.0 + 2.0 / 3.0 * 10.0 * 5.0 * bulge, 2e-9)
            << bulge;
    }
}

TEST(ToolsDxf, InsertsMayBeRowsAndColumnsOfABlockInAnyCase) {
    const std::string blocks = lines(
        "0 SECTION 2 BLOCKS 0 BLOCK 2 Dot 10 0 20 0 0 CIRCLE 10 0 20 0 40 1 0 ENDBLK 0 "
        "ENDSEC");
    const CurvePath path =
        read_drawing(blocks + drawing("0 INSERT 2 dOT 10 5 20 6 50 90 70 3 71 2 44 10 45 20"));
    ASSERT_EQ(path.contours().size(), 6U);
    // Columns go along the turned x axis, rows to its left.
    EXPECT_NEAR(path.contours()[2].start.y - path.contours()[0].start.y, 20.0, 1e-12);
    EXPECT_NEAR(path.contours()[3].start.x - path.contours()[0].start.x, -20.0, 1e-12);
    EXPECT_NE(refusal(blocks + drawing("0 INSERT 2 dot 10 5 20 6 70 30000 71 30000"))
                  .find("more than 262144 segments"),
              std::string::npos);
}

TEST(ToolsDxf, PlanesAreThoseOfTheAxesUpToRounding) {
    const std::string circle = "0 CIRCLE 10 1 20 0 40 1 210 1e-17 220 -1.2e-16 230 ";
    EXPECT_NEAR(area(read_drawing(drawing(circle + "0.9999999999"))), std::numbers::pi, 1e-5);
    EXPECT_EQ(refusal(drawing(circle + "0.99")),
              "a.dxf:6:1: CIRCLE: does not lie in the plane of x and y");
    EXPECT_EQ(refusal(drawing("0 LINE 10 0 20 0 30 0 11 1 21 0 31 5")),
              "a.dxf:6:1: LINE: does not lie in the plane of x and y");
    EXPECT_NEAR(area(read_drawing(drawing("0 CIRCLE 10 0 20 0 40 1") + "\x1A")), std::numbers::pi,
                1e-5);
}

TEST(ToolsDxf, RefusalsSayWhere) {
    const std::string circle = " 0 CIRCLE 10 0 20 0 40 1";
    EXPECT_EQ(refusal(drawing("0 REGION 70 8" + circle)),
              "a.dxf:6:1: REGION: is not read; convert it to polylines, or remove it");
    EXPECT_EQ(refusal(drawing(line({0, 0}, {1, 0}) + line({1, 0}, {1, 1}))),
              "a.dxf:6:1: the outline is open: nothing continues it at (0, 0)");
    // The first line is continued at both ends.
    EXPECT_NE(refusal(drawing(line({0, 0}, {1, 0}) + line({1, 0}, {1, 1}) + line({0, 0}, {0, 1})))
                  .find("nothing continues it at (1, 1)"),
              std::string::npos);
    EXPECT_EQ(refusal(drawing("0 CIRCLE 10 0 20 zero 40 1")),
              "a.dxf:10:1: group 20: \"zero\" is not a finite number");
    EXPECT_EQ(refusal(drawing("0 CIRCLE 10 0 20 0")), "a.dxf:6:1: CIRCLE: lacks group 40");
    EXPECT_EQ(refusal(drawing("0 CIRCLE 10 2e12 20 0 40 1")),
              "a.dxf:8:1: group 10: numbers must be at most 1e12 in magnitude");
    EXPECT_EQ(refusal(drawing("0 INSERT 2 none 10 0 20 0")),
              "a.dxf:6:1: INSERT: there is no block \"none\"");
    EXPECT_EQ(refusal(drawing("0 TEXT 1 x")), "a.dxf:1:1: has no outline, only TEXT (1)");
    EXPECT_EQ(refusal("0\nSECTION\n2\nENTITIES\n"),
              "a.dxf:2:1: the file ends within its section ENTITIES");
    EXPECT_EQ(refusal("0\nSECTION\nx\nENTITIES\n"),
              "a.dxf:3:1: expected the code of a group, a whole number; found \"x\"");
    EXPECT_EQ(refusal("0\nSECTION\n2"),
              "a.dxf:3:2: the file ends where the value of group 2 should be");
    const std::string itself = lines(
        "0 SECTION 2 BLOCKS 0 BLOCK 2 a 10 0 20 0 0 INSERT 2 b 10 0 20 0 0 ENDBLK 0 BLOCK 2 b 10 0 "
        "20 0 0 INSERT 2 a 10 0 20 0 0 ENDBLK 0 ENDSEC");
    EXPECT_NE(refusal(itself + drawing("0 INSERT 2 a 10 0 20 0")).find("the block holds itself"),
              std::string::npos);
    std::string doubled = "0 SECTION 2 BLOCKS 0 BLOCK 2 b0 10 0 20 0" + circle + " 0 ENDBLK";
    for (int i = 1; i < 40; ++i) {
        const std::string insert = " 0 INSERT 2 b" + std::to_string(i - 1) + " 10 0 20 0";
        doubled +=
            " 0 BLOCK 2 b" + std::to_string(i) + " 10 0 20 0" + insert + insert + " 0 ENDBLK";
    }
    EXPECT_NE(refusal(lines(doubled + " 0 ENDSEC") + drawing("0 INSERT 2 b39 10 0 20 0"))
                  .find("the blocks place more than 262144 segments"),
              std::string::npos);
}

TEST(ToolsDxf, IsKnownByItsBeginning) {
    const std::string text = drawing("0 CIRCLE 10 0 20 0 40 1");
    EXPECT_EQ(format_of({"standard input", text}), OutlineFormat::dxf);
    EXPECT_EQ(format_of({"standard input", "  999\nby hand\n" + text}), OutlineFormat::dxf);
    EXPECT_EQ(format_of({"a.dxf", "x"}), OutlineFormat::dxf);
    EXPECT_EQ(format_of({"standard input", "0103000000"}), OutlineFormat::hex_wkb);
}

TEST(ToolsDxf, LayersThatAreOffOrFrozenAreLeftOut) {
    const auto layer = [](const std::string& name, const std::string& rest) {
        return " 0 LAYER 2 " + name + " " + rest;
    };
    const std::string tables = "0 SECTION 2 TABLES 0 TABLE 2 LAYER" + layer("off", "70 0 62 -7") +
                               layer("FROZEN", "70 1 62 7") + layer("locked", "70 4 62 1") +
                               layer("plain", "") +
                               " 0 ENDTAB 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 2 " +
                               "B 10 0 20 0 0 CIRCLE 8 0 10 9 20 9 40 1 0 ENDBLK 0 ENDSEC";
    const auto square = [](const std::string& name, int x) {
        const std::string left = std::to_string(x);
        const std::string right = std::to_string(x + 1);
        return " 0 LWPOLYLINE 8 " + name + " 70 1 10 " + left + " 20 0 10 " + right + " 20 0 10 " +
               right + " 20 1 10 " + left + " 20 1";
    };
    SkippedParts skipped;
    const CurvePath path = parse_dxf(
        drawing(
            square("locked", 0) + square("Off", 2) + square("plain", 4) + square("nowhere", 6) +
                " 0 POLYLINE 8 frozen 70 1 10 0 20 0 0 VERTEX 8 frozen 10 0 20 0 0 VERTEX 8 0 10 " +
                "2 20 0 0 SEQEND 0 INSERT 8 OFF 2 B 10 0 20 0" + square("0", 8),
            tables),
        "a.dxf", skipped, LengthUnit::user);
    EXPECT_EQ(areas(path).size(), 4U);
    EXPECT_EQ(skipped.text(), "on a layer that is off or frozen (3)");
    const std::string nothing = refusal(drawing(square("off", 0), tables));
    EXPECT_NE(nothing.find("has no outline, only on a layer that is off or frozen (1)"),
              std::string::npos)
        << nothing;
}

}  // namespace
}  // namespace nearfield::tools
