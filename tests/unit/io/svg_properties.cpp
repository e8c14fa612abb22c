#include "support.hpp"

#include <gtest/gtest.h>
#include <tools/io/svg.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

SvgDrawing draw_file(const std::string& file, LengthUnit unit = LengthUnit::user) {
    SkippedParts skipped;
    return parse_svg(file, "a.svg", skipped, unit);
}

std::string path(const std::string& attributes) {
    std::string text = "<path d='M0 0h4v3z' ";
    text += attributes;
    return text += "/>";
}

/// The fill rules of what a drawing draws, a letter each: n(onzero) or e(venodd).
std::string rules(const std::string& content) {
    std::string letters;
    for (const FilledPart& part :
         draw_file("<svg>" + content + path("id='end'") + "</svg>").parts) {
        letters += part.rule == FillRule::nonzero ? 'n' : 'e';
    }
    return letters;
}

/// The corner of the triangle that is at (4, 0) in its own coordinates.
Vector2 corner(const SvgDrawing& drawing) {
    EXPECT_EQ(drawing.path.contours().size(), 1U);
    return drawing.path.contours()[0].segments[0].to;
}

void expect_corner(const std::string& file, double x, double y,
                   LengthUnit unit = LengthUnit::user) {
    const Vector2 actual = corner(draw_file(file, unit));
    EXPECT_NEAR(actual.x, x, 1e-12 * (1.0 + std::abs(x))) << file;
    EXPECT_NEAR(actual.y, y, 1e-12 * (1.0 + std::abs(y))) << file;
}

std::string error(const std::string& content) {
    return input_error([&] { return draw_file("<svg>\n" + content + "\n</svg>"); });
}

TEST(ToolsSvgProperties, FillRulesAreInheritedAndStylesComeFirst) {
    EXPECT_EQ(rules(path("") + path("fill-rule='evenodd'") + path("style='fill-rule:evenodd'")),
              "neen");
    EXPECT_EQ(rules("<g fill-rule='evenodd'>" + path("") + path("fill-rule='nonzero'") +
                    path("fill-rule='inherit'") + "</g>"),
              "enen");
    EXPECT_EQ(rules(path("fill-rule='evenodd' style=' Fill-Rule : nonzero ; x'")), "nn");
    EXPECT_EQ(rules(path("style='fill-rule:evenodd!important;fill-rule:nonzero'")), "en");
    EXPECT_EQ(rules(path("style='fill:url(a;fill-rule:evenodd)'")), "nn");
    EXPECT_EQ(rules(path("style='/*fill-rule:evenodd*/'")), "nn");
    EXPECT_EQ(error(path("fill-rule='odd'")),
              "a.svg:2:2: path: the fill-rule \"odd\" is neither nonzero nor evenodd");
}

TEST(ToolsSvgProperties, StyleSheetsBySpecificityAndOrder) {
    const auto with = [&](const std::string& sheet, const std::string& attributes) {
        return rules("<style>" + sheet + "</style>" + path(attributes)).substr(0, 1);
    };
    EXPECT_EQ(with(".a{fill-rule:evenodd}", "class='b a'"), "e");
    EXPECT_EQ(with(".a{fill-rule:evenodd}", "class='ba'"), "n");
    EXPECT_EQ(with("path.a#p, circle{fill-rule:evenodd}", "class='a' id='p'"), "e");
    EXPECT_EQ(with("rect.a{fill-rule:evenodd}", "class='a'"), "n");
    EXPECT_EQ(with("#p{fill-rule:nonzero} .a{fill-rule:evenodd}", "class='a' id='p'"), "n");
    EXPECT_EQ(with(".a{fill-rule:nonzero} .a{fill-rule:evenodd}", "class='a'"), "e");
    EXPECT_EQ(with("*{fill-rule:evenodd}", "fill-rule='nonzero'"), "e");
    EXPECT_EQ(with(".a{fill-rule:evenodd}", "class='a' style='fill-rule:nonzero'"), "n");
    EXPECT_EQ(with(".a{fill-rule:evenodd!important}", "class='a' style='fill-rule:nonzero'"), "e");
    EXPECT_EQ(with("/* x */ @import 'b.css'; <![CDATA[.a{fill-rule:evenodd}]]>", "class='a'"), "e");
    EXPECT_EQ(with("@font-face{src:x;display:swap} g > .a{fill:red} .a:hover{stroke:blue}", ""),
              "n");
    EXPECT_EQ(error("<style>\ng > .a {display:none}</style>"),
              "a.svg:3:1: the rule \"g > .a\" matters to geometry; only those of elements, classes "
              "and ids are read");
    EXPECT_NE(error("<style>@media print{.a{display:none}}</style>").find("2:21: the rule \".a\""),
              std::string::npos);
}

TEST(ToolsSvgProperties, WhatIsNotDisplayedIsNotDrawn) {
    EXPECT_EQ(rules(path("style='display:none'") + "<g display='none'>" + path("") + "</g>"), "n");
    EXPECT_EQ(rules("<style>.off{display:none}</style>" + path("class='off'")), "n");
    // What is hidden may have visible children.
    EXPECT_EQ(rules("<g visibility='hidden'>" + path("") + path("visibility='visible'") + "</g>"),
              "nn");
    EXPECT_EQ(rules("<circle r='0'/><rect width='0' height='3'/>"), "n");
    EXPECT_EQ(rules("<switch><g requiredExtensions='x'>" + path("") + "</g>" + path("") + path("") +
                    "</switch>"),
              "nn");
}

TEST(ToolsSvgProperties, TransformsOfStylesHaveUnits) {
    const auto expect_moved = [](const std::string& attributes, double x, double y) {
        expect_corner("<svg>" + path(attributes) + "</svg>", x, y);
    };
    expect_moved("style='transform: translate(1px, 2mm)'", 5.0, -2.0 * 96.0 / 25.4);
    expect_moved("style='transform:rotate(0.25turn)' transform='scale(9)'", 0.0, -4.0);
    expect_moved("transform='rotate(100grad)'", 0.0, -4.0);
    expect_moved("transform='translateX(3) scaleX(2)'", 11.0, 0.0);
    expect_moved("transform='none'", 4.0, 0.0);
    EXPECT_NE(error(path("transform='rotate(3px)'")).find("\"px\" is none of deg"),
              std::string::npos);
    EXPECT_NE(error(path("transform='scale(3px)'")).find("\"px\" is no unit of scale"),
              std::string::npos);
    EXPECT_EQ(error(path("transform='scale(2)' style='transform-origin:center'")),
              "a.svg:2:2: path: transform-origin is not read");
    EXPECT_EQ(error(path("style='scale:2'")), "a.svg:2:2: path: scale in a style is not read");
    EXPECT_EQ(error(path("style='clip-path:url(#c)'")),
              "a.svg:2:2: path: clip-path is not read, unless it keeps the whole canvas");
}

TEST(ToolsSvgProperties, UsesPlaceWhatTheyReferTo) {
    const std::string defs = "<defs><g id='t'>" + path("") + "</g></defs>";
    expect_corner("<svg>" + defs + "<use href='#t' x='1' y='2' transform='scale(3)'/></svg>", 15.0,
                  -6.0);
    expect_corner("<svg>" + defs + "<g id='u'><use xlink:href='#t'/></g></svg>", 4.0, 0.0);
    // A use decides about what its target inherits.
    EXPECT_EQ(rules(defs + "<use href='#t' fill-rule='evenodd'/>"), "en");
    const std::string symbol = "<symbol id='s' viewBox='0 0 8 8'>" + path("") + "</symbol>";
    expect_corner("<svg>" + symbol + "<use href='#s' width='16' height='16'/></svg>", 8.0, 0.0);
    EXPECT_EQ(error("<use href='#x'/>"), "a.svg:2:2: use: there is no element with the id \"x\"");
    EXPECT_NE(error("<use href='b.svg#x'/>").find("only what is in the file"), std::string::npos);
    EXPECT_EQ(error("<use/>"), "a.svg:2:2: use: needs the attribute href");
    EXPECT_NE(error("<g id='a'><use href='#a'/></g>").find("use: uses itself"), std::string::npos);
    std::string file = "<path id='a0' d='M0 0h4v3z'/>";
    for (int i = 1; i < 12; ++i) {
        const std::string use = "<use href='#a" + std::to_string(i - 1) + "'/>";
        file += "<g id='a" + std::to_string(i) + "'>";
        for (int j = 0; j < 10; ++j) {
            file += use;
        }
        file += "</g>";
    }
    EXPECT_NE(error(file).find("is drawn too often"), std::string::npos);
}

TEST(ToolsSvgProperties, ReferencesMayBePercentEncoded) {
    const std::string defs = "<defs>" + path("id='my part'") +
                             path("id='50%25' transform='scale(2)'") +
                             path("id='50%' transform='scale(3)'") +
                             path("id='\u00e4' transform='scale(4)'") + "</defs>";
    const auto expect_use = [&](const std::string& reference, double x) {
        expect_corner("<svg>" + defs + "<use href='" + reference + "'/></svg>", x, 0.0);
    };
    expect_use("#my part", 4.0);
    expect_use("#my%20part", 4.0);
    expect_use("#50%25", 8.0);  // as it stands comes first
    expect_use("#50%", 12.0);
    expect_use("#%35%30%", 12.0);
    expect_use("#%C3%a4", 16.0);
    EXPECT_NE(error("<use href='#my%2part'/>").find("with the id \"my%2part\""), std::string::npos);
}

TEST(ToolsSvgProperties, SymbolsHaveAPlaceOfTheirOwn) {
    const std::string symbol = "<symbol id='s' x='1' y='2' width='16' height='16' ";
    const std::string end = ">" + path("") + "</symbol><use href='#s' x='10' ";
    expect_corner("<svg>" + symbol + end + "/></svg>", 15.0, -2.0);
    expect_corner("<svg>" + symbol + "viewBox='0 0 8 8'" + end + "/></svg>", 19.0, -2.0);
    expect_corner("<svg>" + symbol + "transform='scale(2)'" + end + "y='3'/></svg>", 20.0, -7.0);
}

/// CSS moves it about the middle of a box whose size a window decides.
TEST(ToolsSvgProperties, ATransformOfTheOutermostElementIsRefused) {
    for (const char* const attribute : {"transform='scale(2)'", "style='transform:scale(2)'"}) {
        EXPECT_EQ(
            input_error([&] {
                return draw_file(std::string("<svg ") + attribute + ">" + path("") + "</svg>");
            }),
            "a.svg:1:2: svg: a transform of the outermost element is not read");
    }
}

TEST(ToolsSvgProperties, LengthsOfStylesNeedAUnit) {
    const auto expect_width = [](const std::string& attributes, double width) {
        const SvgDrawing drawing = draw_file("<svg><rect height='3' " + attributes + "/></svg>");
        EXPECT_EQ(corner(drawing).x, width) << attributes;
    };
    expect_width("width='5' style='width:7'", 5.0);
    expect_width("width='5' style='width:7px'", 7.0);
    expect_width("width='5' style='width:6px;width:7'", 6.0);
    expect_width("width='5' style='width:+7.5e0!important'", 5.0);
    expect_width("width='5' x='3' style='x:0;rx:0.0'", 5.0);
    const SvgDrawing styled = draw_file(
        "<svg><style>.a{width:9} rect{width:8px}</style><rect class='a' height='3'/></svg>");
    EXPECT_EQ(corner(styled).x, 8.0);
}

TEST(ToolsSvgProperties, UnitsAndViewBoxByOption) {
    const std::string end = ">" + path("") + "</svg>";
    const std::string page = "<svg width='210mm' height='297mm' viewBox='0 0 21 29.7'" + end;
    expect_corner(page, 4.0, 0.0);
    expect_corner(page, 40.0, 0.0, LengthUnit::mm);
    expect_corner(page, 4.0, 0.0, LengthUnit::cm);
    expect_corner(page, 40.0 / 25.4, 0.0, LengthUnit::inch);
    expect_corner(page, 40.0 * 96.0 / 25.4, 0.0, LengthUnit::px);
    // One pixel a user unit without a size; an origin elsewhere; one side follows from the other.
    expect_corner("<svg viewBox='1 2 10 10'" + end, 3.0, 2.0, LengthUnit::px);
    expect_corner("<svg width='1in'" + end, 4.0 / 96.0, 0.0, LengthUnit::inch);
    expect_corner("<svg height='20' viewBox='0 0 40 10'" + end, 8.0, 0.0, LengthUnit::px);
    // The box is centred where the shapes differ, or not.
    expect_corner("<svg width='20' height='10' viewBox='0 0 10 10'" + end, 9.0, 0.0,
                  LengthUnit::px);
    expect_corner(
        "<svg width='20' height='10' viewBox='0 0 10 10' preserveAspectRatio='none'" + end, 8.0,
        0.0, LengthUnit::px);
    expect_corner(
        "<svg width='20' height='10' viewBox='0 0 10 10' preserveAspectRatio='xMaxYMid slice'" +
            end,
        8.0, 5.0, LengthUnit::px);
    const std::string nested =
        "<svg><svg x='1' y='2' width='8' height='8' viewBox='0 0 4 4'>" + path("") + "</svg></svg>";
    expect_corner(nested, 9.0, -2.0);
    // Percentages are those of the viewBox.
    expect_corner("<svg viewBox='0 0 8 10'><rect width='50%' height='3'/></svg>", 4.0, 0.0);
    expect_corner("<svg><rect width='1in' height='3'/></svg>", 96.0, 0.0);
    EXPECT_NE(input_error([&] {
                  return draw_file("<svg viewBox='0 0 0 9'" + end);
              }).find("have to be above 0"),
              std::string::npos);
}

}  // namespace
}  // namespace nearfield::tools
