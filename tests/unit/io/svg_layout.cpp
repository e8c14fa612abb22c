#include "support.hpp"

#include <gtest/gtest.h>
#include <tools/io/svg.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

SvgLayout layout(const std::string& content) {
    SkippedParts skipped;
    return parse_svg_layout("<svg>" + content + "</svg>", "a.svg", skipped);
}

std::vector<std::string> names(const SvgLayout& layout) {
    std::vector<std::string> names;
    for (const SvgItem& item : layout.items) {
        names.push_back(item.name);
    }
    return names;
}

/// The rings of an item where it is.
std::vector<Ring> placed(const SvgLayout& layout, std::size_t item) {
    const Pose& pose = layout.items.at(item).pose;
    CurvePath path = layout.shapes.at(layout.items.at(item).shape).path;
    const double cosine = std::cos(pose.angle);
    const double sine = std::sin(pose.angle);
    path.transform({{cosine, sine}, {-sine, cosine}, pose.translation});
    return *tessellate(path, 0.01);
}

TEST(ToolsSvgLayout, ItemsAreUsesGroupsOfOutlinesAndOtherOutlines) {
    const SvgLayout read = layout(
        "<defs><g id='part'><path d='M0 0h4v3z'/><circle cx='3' cy='1' r='.5'/></g>"
        "<rect id='square' width='1' height='1'/></defs>"
        "<g id='bin'><path d='M0 0h9v9h-9z'/><title>t</title></g>"
        "<g id='items'><use href='#part' transform='translate(1 1),rotate(30)'/>"
        "<use id='own' href='#part' transform='translate(2 1) rotate(-75)'/>"
        "<use href='#square' x='3'/><use href='#square' x='4' y='2'/></g>"
        "<g inkscape:groupmode='layer'><circle r='1'/><ellipse id='e' rx='1' ry='2'/></g>"
        "<g><use href='#square' x='7'/><rect width='1' height='1'/></g>"
        "<polygon points='0,0 1,0 1,1'/><text>ignored</text>");
    EXPECT_EQ(names(read), (std::vector<std::string>{"bin", "part", "own", "square", "square",
                                                     "circle", "e", "square", "rect", "polygon"}));
    EXPECT_EQ(read.items[1].shape, read.items[2].shape);
    EXPECT_EQ(read.items[3].shape, read.items[4].shape);
    EXPECT_EQ(read.items[4].shape, read.items[7].shape);
    EXPECT_EQ(read.shapes.size(), 7U);
    EXPECT_EQ(read.shapes[read.items[1].shape].parts.size(), 2U);
    EXPECT_EQ(read.items[4].pose.translation, (Vector2{4.0, -2.0}));
}

TEST(ToolsSvgLayout, PlacesWhatIsDrawnWhereItIsDrawn) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-50.0, 50.0);
    const auto text = [&] { return std::to_string(number(random)); };
    for (int round = 0; round < 200; ++round) {
        std::string transform = "translate(" + text() + " " + text() + ") rotate(" + text() + ")";
        if (round % 4 == 1) {
            transform += " scale(-1 1)";
        } else if (round % 4 == 2) {
            transform += " skewX(20) scale(2)";
        } else if (round % 4 == 3) {
            transform = "matrix(" + text() + " " + text() + " " + text() + " " + text() + " 5 6)";
        }
        const std::string content = "<defs><path id='p' d='M0 0h4l1 3-3 2z' transform='rotate(" +
                                    text() + ")'/></defs><g transform='rotate(" + text() +
                                    ")'><use href='#p' x='2' transform='" + transform + "'/></g>";
        SkippedParts skipped;
        const std::vector<Ring> drawn =
            *tessellate(parse_svg("<svg>" + content + "</svg>", "a", skipped).path, 0.01);
        const std::vector<Ring> rings = placed(layout(content), 0);
        ASSERT_EQ(rings.size(), drawn.size());
        ASSERT_EQ(rings[0].size(), drawn[0].size());
        for (std::size_t i = 0; i < drawn[0].size(); ++i) {
            EXPECT_NEAR(rings[0][i].x, drawn[0][i].x, 1e-11) << content;
            EXPECT_NEAR(rings[0][i].y, drawn[0][i].y, 1e-11) << content;
        }
    }
}

TEST(ToolsSvgLayout, ShapesAreSharedWhereOnlyPosesDiffer) {
    std::string content = "<defs><path id='p' d='M0 0h4v3z'/></defs>";
    for (int degrees = 0; degrees < 360; degrees += 7) {
        const std::string turn = "rotate(" + std::to_string(degrees) + ")";
        content += "<use href='#p' transform='translate(1 2) " + turn + "'/>";
        content += "<use href='#p' transform='scale(3) " + turn + "'/>";
        content += "<use href='#p' transform='" + turn + " scale(1 -1)'/>";
    }
    const SvgLayout read = layout(content + "<use href='#p' fill-rule='evenodd'/>");
    EXPECT_EQ(read.items.size(), 52U * 3U + 1U);
    EXPECT_EQ(read.shapes.size(), 4U);
}

TEST(ToolsSvgLayout, SymbolsKeepTheirSizes) {
    const SvgLayout read = layout(
        "<symbol id='s' viewBox='0 0 4 4'><path d='M0 0h4v3z'/></symbol>"
        "<use href='#s' x='1' width='8' height='8'/><use href='#s' x='2' width='4' height='4'/>");
    EXPECT_EQ(placed(read, 0), (std::vector<Ring>{{{1, 0}, {9, 0}, {9, -6}}}));
    EXPECT_EQ(placed(read, 1), (std::vector<Ring>{{{2, 0}, {6, 0}, {6, -3}}}));
}

TEST(ToolsSvgLayout, RefusesWhatHasNoArea) {
    EXPECT_EQ(input_error([] { return layout("<g transform='scale(0)'><circle r='1'/></g>"); }),
              "a.svg:1:7: g: its transforms leave no area");
    EXPECT_EQ(input_error([] { return layout("<text>x</text>"); }),
              "a.svg:1:2: svg: has no outline, only text (1)");
    EXPECT_NE(input_error([] {
                  return layout("<g id='a'><g><use href='#a'/></g></g>");
              }).find("uses itself"),
              std::string::npos);
}

}  // namespace
}  // namespace nearfield::tools
