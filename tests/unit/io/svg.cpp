#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/folder.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/svg.hpp>
#include <tools/io/svg_values.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

CurvePath path_data(const std::string& data) {
    const std::string file = "a.path";
    SvgText text(data, 0, data, file);
    return parse_path_data(text);
}

std::vector<Ring> rings(const CurvePath& path, double deviation = 0.01) {
    auto result = tessellate(path, deviation);
    EXPECT_TRUE(result.has_value()) << result.error().text();
    return result.has_value() ? *result : std::vector<Ring>{};
}

void expect_same(const CurvePath& actual, const CurvePath& expected, const std::string& what) {
    const std::vector<Ring> left = rings(actual);
    const std::vector<Ring> right = rings(expected);
    ASSERT_EQ(left.size(), right.size()) << what;
    for (std::size_t r = 0; r < left.size(); ++r) {
        ASSERT_EQ(left[r].size(), right[r].size()) << what << ", ring " << r;
        for (std::size_t v = 0; v < left[r].size(); ++v) {
            EXPECT_NEAR(left[r][v].x, right[r][v].x, 1e-12) << what << ", vertex " << v;
            EXPECT_NEAR(left[r][v].y, right[r][v].y, 1e-12) << what << ", vertex " << v;
        }
    }
}

std::string path_error(const std::string& data) {
    return input_error([&] { return path_data(data); });
}

TEST(ToolsSvgPath, StraightCommandsInEverySpelling) {
    const CurvePath square =
        CurvePath().move_to({1, 2}).line_to({4, 2}).line_to({4, 5}).line_to({1, 5}).close();
    for (const char* const data : {
             "M1 2L4 2L4 5L1 5Z",
             "M 1,2 4,2 4,5 1,5 z",
             "m1 2 3 0 0 3 -3 0z",
             "M1 2H4V5H1Z",
             "m1,2h3v3h-3z",
             "\n M 1.0e0 +2 \t l3-0 0,3-3,0 Z ",
             "M1 2H4V5H1",
             "M1 2L4 2 4 5M1 2",
         }) {
        if (std::string(data).find("M1 2L4 2 4 5M") == 0) {
            EXPECT_EQ(rings(path_data(data)), (std::vector<Ring>{{{1, 2}, {4, 2}, {4, 5}}}));
        } else {
            expect_same(path_data(data), square, data);
        }
    }
    EXPECT_EQ(rings(path_data("M.5.5 1.5.5-1-1e-1")),
              (std::vector<Ring>{{{.5, .5}, {1.5, .5}, {-1, -.1}}}));
}

TEST(ToolsSvgPath, SubpathsBeginWhereTheLastOneBeganOrMoved) {
    EXPECT_EQ(rings(path_data("M1 1h2v2zl-1 0 0-1z m5 5h1v1z")),
              (std::vector<Ring>{
                  {{1, 1}, {3, 1}, {3, 3}}, {{1, 1}, {0, 1}, {0, 0}}, {{6, 6}, {7, 6}, {7, 7}}}));
}

TEST(ToolsSvgPath, CurvesAbsoluteRelativeAndSmooth) {
    const CurvePath cubics = CurvePath()
                                 .move_to({1, 1})
                                 .cubic_to({2, 3}, {4, 3}, {5, 1})
                                 .cubic_to({6, -1}, {8, -1}, {9, 1});
    for (const char* const data : {"M1 1C2 3 4 3 5 1C6-1 8-1 9 1", "M1 1C2 3 4 3 5 1S8-1 9 1",
                                   "M1 1c1 2 3 2 4 0s3-2 4 0", "M1 1C2 3 4 3 5 1 6-1 8-1 9 1z"}) {
        expect_same(path_data(data), cubics, data);
    }
    const CurvePath quadratics = CurvePath()
                                     .move_to({1, 1})
                                     .quadratic_to({2, 3}, {3, 1})
                                     .quadratic_to({4, -1}, {5, 1})
                                     .quadratic_to({6, 3}, {7, 1});
    for (const char* const data :
         {"M1 1Q2 3 3 1Q4-1 5 1Q6 3 7 1", "M1 1Q2 3 3 1T5 1T7 1", "M1 1q1 2 2 0t2 0 2 0"}) {
        expect_same(path_data(data), quadratics, data);
    }
    // Smooth after another command: the control point is the current point.
    expect_same(path_data("M1 1L3 1S5 3 6 1"),
                CurvePath().move_to({1, 1}).line_to({3, 1}).cubic_to({3, 1}, {5, 3}, {6, 1}),
                "S after L");
    expect_same(
        path_data("M1 1C2 3 4 3 5 1T9 1"),
        CurvePath().move_to({1, 1}).cubic_to({2, 3}, {4, 3}, {5, 1}).quadratic_to({5, 1}, {9, 1}),
        "T after C");
}

TEST(ToolsSvgPath, ArcsWithFlagsOfEverySpelling) {
    for (const bool large : {false, true}) {
        for (const bool sweep : {false, true}) {
            const EllipticArc arc{3, 2, 0.5235987755982988, large, sweep};
            const CurvePath expected = CurvePath().move_to({1, 1}).arc_to(arc, {4, 2});
            const std::string l = large ? "1" : "0";
            const std::string s = sweep ? "1" : "0";
            expect_same(path_data("M1 1A3 2 30 " + l + " " + s + " 4 2"), expected, "spaces");
            expect_same(path_data("M1,1a3,2,30," + l + "," + s + ",3,1"), expected, "commas");
            expect_same(path_data("M1 1A3 2 30 " + l + s + "4 2"), expected, "nothing between");
            expect_same(path_data("M1 1a3-2 30 " + l + s + "3+1"), expected, "signs");
        }
    }
    // A flag is one digit; the number after it may start with a point.
    expect_same(path_data("M0 0a1 1 0 01.5.5"),
                CurvePath().move_to({0, 0}).arc_to({1, 1, 0, false, true}, {.5, .5}), "packed");
    expect_same(path_data("M0 0A0 1 0 0 1 2 2L0 2"),
                CurvePath().move_to({0, 0}).line_to({2, 2}).line_to({0, 2}), "no radius");
}

TEST(ToolsSvgPath, ErrorsNameFileLineAndColumn) {
    EXPECT_EQ(path_error("L1 1"), "a.path:1:1: path data begins with M or m");
    EXPECT_EQ(path_error("M1 1\nL2 x"), "a.path:2:4: expected a number");
    EXPECT_EQ(path_error("M1 1 L2"), "a.path:1:8: the value ends where a number is expected");
    EXPECT_EQ(path_error("M1 1 X2 2"), "a.path:1:6: 'X' is no command of path data");
    EXPECT_EQ(path_error("M1 1,L2 2"), "a.path:1:6: expected a number after the comma");
    EXPECT_EQ(path_error("M1,,1"), "a.path:1:4: expected a number");
    EXPECT_EQ(path_error("M1 1A1 1 0 2 0 3 3"), "a.path:1:12: expected a flag, 0 or 1");
    EXPECT_EQ(path_error("M1 1 Z 3 3"), "a.path:1:8: '3' is no command of path data");
    EXPECT_EQ(path_error("M1 1e999"),
              "a.path:1:4: a number too large or too small for double precision");
    for (const char* const word : {"inf", "nan", "-inf", "+-1", "- 1", "-.", "."}) {
        EXPECT_NE(path_error(std::string("M1 ") + word).find("a number"), std::string::npos)
            << word;
    }
}

CurvePath parse(const std::string& text, const std::string& file) {
    SkippedParts skipped;
    return parse_svg(text, file, skipped).path;
}

CurvePath svg(const std::string& content) {
    return parse("<svg xmlns=\"http://www.w3.org/2000/svg\">" + content + "</svg>", "a.svg");
}

std::string svg_error(const std::string& content) {
    return input_error([&] { return parse("<svg>\n" + content + "\n</svg>", "a.svg"); });
}

TEST(ToolsSvg, EveryElementWithYTurnedAround) {
    EXPECT_EQ(rings(svg("<path d='M0 0h4v3z'/>")), (std::vector<Ring>{{{0, 0}, {4, 0}, {4, -3}}}));
    EXPECT_EQ(rings(svg("<polygon points='0,0 4,0 4,3'/>")),
              (std::vector<Ring>{{{0, 0}, {4, 0}, {4, -3}}}));
    EXPECT_EQ(rings(svg("<polyline points='0 0 4 0 4 3 0 0'/>")),
              (std::vector<Ring>{{{0, 0}, {4, 0}, {4, -3}}}));
    EXPECT_EQ(rings(svg("<rect x='1' y='2px' width='3' height='4'/>")),
              (std::vector<Ring>{{{1, -2}, {4, -2}, {4, -6}, {1, -6}}}));
    const AffineMap flip{{1, 0}, {0, -1}, {0, 0}};
    expect_same(svg("<circle cx='1' cy='2' r='3'/>"), CurvePath().circle({1, 2}, 3).transform(flip),
                "circle");
    expect_same(svg("<ellipse cx='1' rx='3' ry='2'/>"),
                CurvePath().ellipse({1, 0}, 3, 2).transform(flip), "ellipse");
    expect_same(svg("<ellipse ry='2'/>"), CurvePath().ellipse({}, 2, 2).transform(flip),
                "ellipse of one radius");
    // Rounded corners: a quarter circle each, in the usual order; radii are limited to half a side.
    const CurvePath rounded = CurvePath()
                                  .move_to({2, 0})
                                  .line_to({8, 0})
                                  .arc_to({2, 3}, {10, 3})
                                  .arc_to({2, 3}, {8, 6})
                                  .line_to({2, 6})
                                  .arc_to({2, 3}, {0, 3})
                                  .arc_to({2, 3}, {2, 0})
                                  .close()
                                  .transform(flip);
    expect_same(svg("<rect width='10' height='6' rx='2' ry='9'/>"), rounded, "rect");
    // One radius applies to both axes.
    for (const char* const one : {"rx='1'", "ry='1'"}) {
        EXPECT_EQ(rings(svg("<rect width='10' height='6' " + std::string(one) + "/>")),
                  rings(svg("<rect width='10' height='6' rx='1' ry='1'/>")));
    }
}

TEST(ToolsSvg, TransformsNestAndGoFromRightToLeft) {
    EXPECT_EQ(rings(svg("<g transform='translate(10)'><g transform=' scale(2, 3) '>"
                        "<polygon points='0,0 4,0 4,3' transform='translate(1,1)'/></g></g>")),
              (std::vector<Ring>{{{12, -3}, {20, -3}, {20, -12}}}));
    EXPECT_EQ(
        rings(svg("<polygon points='0,0 4,0 4,3' transform='matrix(0 1 -1 0 5 6),scale(2)'/>")),
        (std::vector<Ring>{{{5, -6}, {5, -14}, {-1, -14}}}));
    const std::vector<Ring> turned =
        rings(svg("<polygon points='3,2 5,2 5,3' transform='rotate(90 3 2)'/>"));
    // In SVG a quarter turn rotates x to y, which points down.
    EXPECT_NEAR(turned[0][1].x, 3.0, 1e-12);
    EXPECT_NEAR(turned[0][1].y, -4.0, 1e-12);
    const std::vector<Ring> skewed =
        rings(svg("<polygon points='0,0 4,0 4,4' transform='skewX(45)skewY(0)'/>"));
    EXPECT_NEAR(skewed[0][2].x, 8.0, 1e-12);
    // A circle under a shear is an ellipse, not a sheared polygon.
    const std::vector<Ring> sheared =
        rings(svg("<circle r='1' transform='skewX(60) scale(100)'/>"), 0.001);
    EXPECT_GT(sheared[0].size(), 300U);
}

TEST(ToolsSvg, WhatDrawsNothingIsPassedOver) {
    const std::string file =
        "<?xml version=\"1.0\"?>\n<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"svg11.dtd\">\n"
        "<!-- drawn by hand -->\n<svg:svg xmlns:svg='http://www.w3.org/2000/svg' viewBox='0 0 9 "
        "9'><svg:title>x</svg:title>"
        "<sodipodi:namedview id='n'/><svg:defs><svg:text>t</svg:text></svg:defs>"
        "<svg:path display='none' d='nonsense'/><svg:g display='none'><svg:use/></svg:g>"
        "<svg:path style='fill:none;stroke:#000' d='M0 0h4v3z'/></svg:svg>";
    EXPECT_EQ(rings(parse(file, "f")), (std::vector<Ring>{{{0, 0}, {4, 0}, {4, -3}}}));
}

TEST(ToolsSvg, ErrorsNameFileLineAndColumn) {
    EXPECT_EQ(svg_error("<text>hello</text><image/><text/>"),
              "a.svg:1:2: svg: has no outline, only text (2), image (1)");
    EXPECT_EQ(svg_error("<pth/>").rfind("a.svg:2:2: pth: is no element that is read: path,", 0),
              0U);
    EXPECT_EQ(svg_error("<g>\n  <path\n d='M0 0 L1 q'/></g>"), "a.svg:4:13: expected a number");
    EXPECT_EQ(svg_error("<path d='M0 0h1v1z' transform='turn(3)'/>"),
              "a.svg:2:32: \"turn\" is none of matrix, translate, scale, rotate, skewX, skewY");
    EXPECT_EQ(svg_error("<path d='M0 0h1v1z' transform='rotate(1 2)'/>"),
              "a.svg:2:32: rotate takes one or three numbers, not 2 numbers");
    EXPECT_EQ(svg_error("<path d='M0 0h1v1z' transform='scale(1'/>"),
              "a.svg:2:39: the value ends where a number is expected");
    EXPECT_EQ(svg_error("<circle r='1em'/>"),
              "a.svg:2:13: \"em\" is none of px, mm, cm, Q, in, pt, pc, %");
    EXPECT_EQ(svg_error("<rect width='50%' height='1'/>"),
              "a.svg:2:16: a percentage without a viewBox, or a width and height, to refer to");
    EXPECT_EQ(svg_error("<rect width='5 5' height='1'/>"),
              "a.svg:2:15: expected a length: one number and its unit");
    EXPECT_EQ(svg_error("<rect width='-5' height='1'/>"), "a.svg:2:2: rect: width is below 0");
    EXPECT_EQ(svg_error("<ellipse rx='1' ry='-1'/>"), "a.svg:2:2: ellipse: ry is below 0");
    EXPECT_EQ(svg_error("<circle cx='1'/><path d=' '/><polygon/><rect width='2'/>"),
              "a.svg:1:2: svg: has no outline, only empty part (4)");
    EXPECT_EQ(svg_error("<polygon points='1 1 2'/>"),
              "a.svg:2:23: the value ends where a number is expected");
    EXPECT_EQ(svg_error("<g clip-path='url(#c)'/>"),
              "a.svg:2:2: g: clip-path is not read, unless it keeps the whole canvas");
    EXPECT_EQ(svg_error(""), "a.svg:1:2: svg: has no outline");
    EXPECT_EQ(svg_error("<g>").rfind("a.svg:", 0), 0U);
    EXPECT_NE(svg_error("<g>").find("not XML"), std::string::npos);
    EXPECT_EQ(input_error([] { return parse("<html/>", "a.svg"); }),
              "a.svg:1:2: the outermost element is \"html\", not svg");
    EXPECT_EQ(input_error([] { return parse("<svg/>\n<svg/>", "a.svg"); }),
              "a.svg:2:2: not XML: a second outermost element");
}

TEST(ToolsSvg, DeepNestingIsNoTrouble) {
    std::string open;
    std::string closed;
    for (int i = 0; i < 1000; ++i) {
        open += "<g>";
        closed += "</g>";
    }
    EXPECT_EQ(rings(svg(open + "<path d='M0 0h4v3z'/>" + closed)).size(), 1U);
    EXPECT_NE(
        svg_error(open + open + "<path d='M0 0h4v3z'/>" + closed + closed).find("nested too deep"),
        std::string::npos);
}

TEST(ToolsOutline, SvgAndPathDataByExtensionAndContent) {
    const test_support::Folder folder;
    const std::vector<Ring> triangle{{{0, 0}, {4, 0}, {4, -3}}};
    const std::string file = "<svg><path d='M0 0h4v3z'/></svg>";
    for (const std::string& path :
         {folder.write("a.SVG", file), folder.write("b", "\n" + file),
          folder.write("c.path", "M0 0h4v3z"), folder.write("d", " m0 0h4v3z"),
          folder.write("e.txt", "M\n0 0h4v3z")}) {
        const Outline outline = read_outline(path);
        EXPECT_FALSE(outline.curved()) << path;
        const OutlineRings result = tessellate_outline(outline, 0.5);
        EXPECT_EQ(result.rings, triangle) << path;
        EXPECT_EQ(result.deviation, 0.0) << path;
    }
    const OutlineRings circle =
        tessellate_outline(read_outline(folder.write("f.svg", "<svg><circle r='3'/></svg>")), 0.5);
    EXPECT_EQ(circle.deviation, 0.5);
    const std::string multi = "MULTIPOLYGON(((0 0, 4 0, 4 -3)))";
    EXPECT_EQ(read_outline(folder.write("g", multi)).rings, triangle);
    const std::string far = folder.write("h.svg", "<svg><circle cx='1e9' r='3'/></svg>");
    EXPECT_EQ(input_error([&] {
                  return tessellate_outline(read_outline(far), 1e-9);
              }).rfind(far + ": the deviation 1e-09 is below", 0),
              0U);
}

}  // namespace
}  // namespace nearfield::tools
