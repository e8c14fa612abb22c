#include <gtest/gtest.h>
#include <tests/simulation/simulation.hpp>
#include <tests/support/degenerate_polygons.hpp>
#include <tools/drawing/canvas.hpp>
#include <tools/rendering/drawing.hpp>
#include <tools/rendering/pictures.hpp>
#include <tools/rendering/vulkan_painter.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::test {
namespace {

constexpr int side = 240;
constexpr tools::Color ink = tools::rgb(0x204080);

/// One painter for all tests, because creating one takes time.
class Painter : public testing::Test {
protected:
    static tools::FrameImage paint(const tools::Drawing& drawing) {
        static const tools::GpuInstance instance;
        static const tools::Gpu gpu(instance);
        static tools::OffscreenPage page(gpu, side, side);
        return page.paint(drawing);
    }

    static int difference(std::uint32_t a, std::uint32_t b) {
        int most = 0;
        for (unsigned shift = 0; shift < 24; shift += 8) {
            most = std::max(most, std::abs(static_cast<int>(a >> shift & 0xFFU) -
                                           static_cast<int>(b >> shift & 0xFFU)));
        }
        return most;
    }

    /// Four samples per pixel give the coverage to slightly more than a quarter. Cairo's is nearly
    /// exact; thin slivers can lie between samples.
    static void expect_alike(const tools::FrameImage& painted, const tools::Canvas& canvas,
                             const std::string& what, std::size_t max_slivers = 0) {
        const std::vector<std::uint32_t> expected = canvas.pixels();
        ASSERT_EQ(painted.pixels.size(), expected.size());
        constexpr int contrast = 0xF5 - 0x20;  // between the panel's red and the ink's
        std::size_t far_off = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const int off = difference(painted.pixels[i], expected[i]);
            far_off += off > contrast * 2 / 5 ? 1U : 0U;
        }
        EXPECT_LE(far_off, max_slivers) << what;
    }
};

TEST_F(Painter, FillsDegenerateRingsByTheOddEvenRule) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        for (const support::DegeneratePolygon& polygon :
             support::degenerate_polygons(side, side, seed)) {
            std::vector<Ring> rings;
            for (const auto& ring : polygon.rings) {
                Ring& copy = rings.emplace_back();
                for (const auto& vertex : ring) {
                    copy.push_back({vertex.x(), vertex.y()});
                }
            }
            tools::Canvas canvas(side, side, tools::palette::panel);
            canvas.fill(rings, ink);
            tools::Drawing drawing;
            drawing.fill(rings, ink);
            expect_alike(paint(drawing), canvas, polygon.name, 8);
        }
    }
}

TEST_F(Painter, AFillHasNoSeams) {
    // Translucent, so that anything painted twice or not at all is visible.
    const Ring star{{120.3, 7.0},   {150.1, 90.7}, {232.9, 91.3}, {167.2, 141.1}, {190.6, 229.8},
                    {121.1, 177.7}, {49.2, 230.3}, {73.8, 142.9}, {8.1, 90.2},    {91.7, 91.9}};
    tools::Drawing drawing;
    drawing.fill({star}, ink.with_alpha(0.5));
    const tools::FrameImage image = paint(drawing);
    const std::uint32_t middle = image.pixels[std::size_t{120} * side + 120];
    for (std::size_t y = 95; y < 140; ++y) {
        for (std::size_t x = 95; x < 145; ++x) {
            ASSERT_EQ(image.pixels[y * side + x], middle) << x << ", " << y;
        }
    }
}

TEST_F(Painter, DrawsLinesDotsAndCells) {
    const std::vector<Vector2> zigzag{{20.0, 30.0}, {200.0, 60.0}, {60.0, 120.0}, {210.0, 200.0}};
    const Ring outline{{20.0, 90.0}, {40.0, 130.0}, {15.0, 160.0}};
    tools::Canvas canvas(side, side, tools::palette::panel);
    canvas.stroke_open(std::span(&zigzag, 1), {ink, 9.0});
    canvas.stroke(std::span(&outline, 1), {ink, 9.0});
    canvas.dot({60.5, 190.0}, 17.0, ink);
    canvas.fill(Rectangle{{100.0, 210.0}, {160.0, 230.0}}, ink);
    tools::Drawing drawing;
    drawing.line(zigzag, ink, 9.0);
    drawing.line(outline, ink, 9.0, true);
    drawing.dot({60.5, 190.0}, 17.0, ink);
    drawing.cells({{{100.0, 210.0}, {160.0, 230.0}}, 3, 1, {ink, ink, ink}});
    expect_alike(paint(drawing), canvas, "lines");
}

TEST_F(Painter, PlacesTextByItsStartMiddleOrEnd) {
    const std::string words = "clearance 0.25";
    for (const tools::Align align :
         {tools::Align::left, tools::Align::center, tools::Align::right}) {
        tools::Drawing drawing;
        drawing.text({120.0, 100.0}, words, 17.0, ink, align);
        tools::Canvas canvas(side, side, tools::palette::panel);
        for (const auto& character : canvas.text_outlines({120.0, 100.0}, words, 17.0, align)) {
            canvas.fill(character, ink);
        }
        expect_alike(paint(drawing), canvas, "text", 30);
    }
}

TEST(Mesh, WhatIsAddedComesAfterTheDrawing) {
    tools::Drawing drawing;
    drawing.dot({5.0, 5.0}, 2.0, ink);
    tools::Mesh mesh(10, 10);
    mesh.add(drawing);
    const auto vertices = static_cast<std::uint32_t>(mesh.vertices().size());
    const auto indices = static_cast<std::uint32_t>(mesh.indices().size());
    const std::vector<tools::MeshVertex> triangle(3);
    const std::vector<std::uint16_t> corners{0, 1, 2};
    const std::vector<tools::MeshPart> parts{{0, 0, 10, 10, 0, 3}};
    mesh.add(triangle, corners, parts);
    EXPECT_EQ(std::vector(mesh.indices().end() - 3, mesh.indices().end()),
              (std::vector<std::uint32_t>{vertices, vertices + 1, vertices + 2}));
    EXPECT_EQ(mesh.parts().back().first, indices);
}

TEST(Solids, NearOnesAreDrawnOverFarOnes) {
    simulation::Scene scene;
    for (const double away : {0.0, 2.0, 1.0}) {
        add_body(scene, box(1.0, 0.5), {{0.0, away}});
        scene.looks.back().height = 0.4;
    }
    tools::Drawing drawing;
    tools::draw_bodies(drawing, scene,
                       tools::View({{-2.0, -2.0}, {2.0, 4.0}}, {{0.0, 0.0}, {240.0, 240.0}}));
    // The headlights of each car come last.
    std::vector<double> lamps;
    for (const tools::DrawnItem& item : drawing.items()) {
        if (const auto* const dot = std::get_if<tools::DrawnDot>(&item)) {
            lamps.push_back(dot->center.y);
        }
    }
    ASSERT_EQ(lamps.size(), 6U);
    EXPECT_LT(lamps[1], lamps[2]);
    EXPECT_LT(lamps[3], lamps[4]);
}

TEST_F(Painter, APageIsPaintedAnewEachTime) {
    tools::Drawing drawing;
    drawing.dot({120.0, 120.0}, 50.0, ink);
    const tools::FrameImage first = paint(drawing);
    const tools::FrameImage empty = paint({});
    EXPECT_NE(first.pixels, empty.pixels);
    EXPECT_EQ(std::count(empty.pixels.begin(), empty.pixels.end(), empty.pixels.front()),
              side * side);
    EXPECT_EQ(empty.pixels.front(), tools::pixel_of(tools::palette::panel));
    EXPECT_EQ(paint(drawing).pixels, first.pixels);
}

}  // namespace
}  // namespace nearfield::test
