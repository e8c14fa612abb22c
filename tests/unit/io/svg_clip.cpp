#include "support.hpp"

#include <gtest/gtest.h>
#include <tools/io/svg.hpp>

#include <string>

namespace nearfield::tools {
namespace {

const std::string clip_view = "<svg viewBox='10 20 100 50'>";
const std::string part = "<path d='M0 0h4v3z'/>";

SvgDrawing draw(const std::string& content, const std::string& root = clip_view) {
    SkippedParts skipped;
    return parse_svg(root + content + "</svg>", "a.svg", skipped, LengthUnit::mm);
}

/// A group with a part that a clip-path of this content clips.
std::string clipped(const std::string& content, const std::string& group = "",
                    const std::string& clip = "") {
    return "<clipPath id='c' " + clip + ">" + content + "</clipPath><g clip-path='url(#c)' " +
           group + ">" + part + "</g>";
}

void expect_drawn(const std::string& content, const std::string& root = clip_view) {
    EXPECT_EQ(draw(content, root).parts.size(), 1U) << content;
}

void expect_refused(const std::string& content, const std::string& root = clip_view) {
    const std::string error = input_error([&] { return draw(content, root); });
    EXPECT_NE(error.find("g: clip-path is not read, unless it keeps the whole canvas"),
              std::string::npos)
        << content << error;
}

const std::string whole = "<rect x='10' y='20' width='100' height='50'/>";

TEST(ToolsSvgClip, TheWholeCanvasMayBeKept) {
    expect_drawn(clipped(whole));
    expect_drawn(clipped("<title>page</title>" + whole));
    expect_drawn(clipped("<path d='M10 20h100v50H10z'/>"));
    expect_drawn(clipped("<path d='M10 20v50h100V20z'/>"));
    expect_drawn(clipped("<path d='M10 20h100v50h-100v-50z'/>"));
    expect_drawn(clipped("<polygon points='0,0 300,0 0,300'/>"));
    expect_drawn(clipped("<rect x='10' y='20' width='99.999' height='50'/>"));
    expect_drawn(clipped("<rect width='55' height='35' transform='scale(2)'/>"));
    expect_drawn("<g clip-path='none' mask='none'>" + part + "</g>");
    expect_drawn(clipped("<rect x='1' y='2' width='10' height='5'/>", "transform='scale(10)'"));
    expect_drawn(clipped("<rect width='30' height='40'/>"), "<svg width='30' height='40'>");
    // Of a page whose sides do not have the ratio of the viewBox, more is seen.
    const std::string wide = "<svg width='400' height='100' viewBox='10 20 100 50'>";
    expect_refused(clipped(whole), wide);
    expect_drawn(clipped("<rect x='-40' y='20' width='200' height='50'/>"), wide);
    expect_drawn(clipped(whole), "<svg width='210mm' height='105.001mm' viewBox='10 20 100 50'>");
    expect_drawn("<g style='clip-path:url(\"#c\")'>" + part + "</g><clipPath id='c'>" + whole +
                 "</clipPath>");
}

TEST(ToolsSvgClip, WhatCutsTheCanvasIsRefused) {
    expect_refused(clipped("<rect x='11' y='20' width='100' height='50'/>"));
    expect_refused(clipped("<rect x='10' y='20' width='99.9' height='50'/>"));
    expect_refused(clipped(whole, "transform='translate(1)'"));
    expect_refused(clipped(whole, "transform='scale(0)'"));
    expect_refused(clipped("<polygon points='0,0 150,0 0,150'/>"));
    expect_refused(clipped("<polygon points='0,0 300,0 300,300 20,40'/>"));
    expect_refused(clipped("<circle r='1000'/>"));
    expect_refused(clipped("<path d='M0 0h300v300h-300v-200l-1 -1z'/>"));
    expect_refused(clipped(whole + whole));
    expect_refused(clipped("<path d='M0 0h300v300h-300z m20 30h9v9h-9z'/>"));
    expect_refused(clipped("<g>" + whole + "</g>"));
    expect_refused(clipped(""));
    expect_refused(clipped(whole, "", "clipPathUnits='objectBoundingBox'"));
    expect_refused(clipped(whole, "", "transform='scale(2)'"));
    expect_refused(clipped(whole, "", "clip-path='url(#d)'"));
    expect_refused(clipped("<rect x='10' y='20' width='100' height='50' visibility='hidden'/>"));
    expect_refused(clipped("<rect x='10' y='20' width='100' height='50' display='none'/>"));
    expect_refused(clipped(whole), "<svg>");
    expect_refused(clipped(whole), "<svg width='0' height='20'>");
    expect_refused("<g clip-path='circle(4000px)'>" + part + "</g>");
    expect_refused("<g clip-path='url(#d)'>" + part + "</g>");
    expect_refused("<g id='d' clip-path='url(#d)'>" + part + "</g>");
}

TEST(ToolsSvgClip, ItemsHaveSeveralPlaces) {
    SkippedParts skipped;
    const auto layout = [&](const std::string& content) {
        return parse_svg_layout(clip_view + content + "</svg>", "a.svg", skipped, LengthUnit::user);
    };
    EXPECT_EQ(layout(clipped(whole) + part).items.size(), 2U);
    // Inside what is used, the canvas is elsewhere each time.
    EXPECT_NE(input_error([&] {
                  return layout("<defs>" + clipped(whole, "id='g'") +
                                "</defs><use href='#g' x='1'/><use href='#g'/>");
              }).find("clip-path is not read"),
              std::string::npos);
}

}  // namespace
}  // namespace nearfield::tools
