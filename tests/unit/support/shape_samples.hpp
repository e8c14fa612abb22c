#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <tests/support/polygons.hpp>

#include <cstdint>
#include <stdexcept>
#include <vector>

/// Test shapes: plain and degenerate ones.
namespace nearfield::samples {

/// A bar of width 2 around the origin with thin upward teeth.
inline Ring comb(std::uint32_t teeth) {
    Ring ring{{1.0, -1.0}, {-1.0, -1.0}};
    const double pitch = 2.0 / teeth;
    for (std::uint32_t i = 0; i < teeth; ++i) {
        const double x = -1.0 + pitch * i;
        ring.insert(
            ring.end(),
            {{x, 1.0}, {x + 0.4 * pitch, 1.0}, {x + 0.4 * pitch, -0.9}, {x + 0.99 * pitch, -0.9}});
    }
    return ring;
}

/// A line that runs back and forth over itself, each time a little shorter, and closes as a sliver.
inline Ring folding(std::uint32_t size) {
    Ring ring;
    for (std::uint32_t i = 0; i < size; ++i) {
        const double shrink = 1e-3 * i / size;
        ring.push_back({i % 2 == 0 ? -1.0 + shrink : 1.0 - shrink, 1e-4 * i / size});
    }
    return ring;
}

/// Shapes around the origin with a radius of about 1.
inline std::vector<test::NamedRings> assorted_shapes(test::Random& random) {
    using test::rectangle;
    using test::scaled_and_moved;
    using test::star;
    std::vector<test::NamedRings> shapes;
    shapes.push_back({"triangle", {{{-1.0, -0.5}, {1.0, -0.5}, {0.0, 1.0}}}});
    shapes.push_back({"sliver", {{{-1.0, 0.0}, {1.0, 1e-7}, {1.0, 0.0}}}});
    shapes.push_back({"star", star(random, 61, 0.2)});
    shapes.push_back({"coast", test::coast(random, 300, 0.5)});
    shapes.push_back({"comb", {comb(40)}});
    shapes.push_back({"tangle", test::tangle(random, 40)});
    shapes.push_back({"bow tie", {{{-1.0, -1.0}, {1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}}}});
    shapes.push_back(
        {"stuttering",
         test::with_repeated_vertices(
             random, test::with_collinear_runs(random, star(random, 17, 0.4), 1.0), 0.5)});
    shapes.push_back({"folding", {folding(60)}});
    shapes.push_back(
        {"spiked", {{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.0}, {1.0, 0.0}, {0.5, 0.0}, {0.0, 0.7}}}});
    shapes.push_back({"with a hole",
                      {star(random, 80, 0.8).front(),
                       scaled_and_moved(star(random, 50, 0.7), 0.7, {}).front()}});
    test::Rings parts;
    for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j) {
            parts.push_back(
                scaled_and_moved(star(random, 9, 0.25), 0.2, {0.4 * i, 0.4 * j}).front());
        }
    }
    shapes.push_back({"many parts", parts});
    test::Rings islands;
    while (islands.size() < 50) {
        const Vector2 place{random.between(-0.9, 0.9), random.between(-0.9, 0.9)};
        islands.push_back(
            scaled_and_moved(star(random, random.whole(3, 20), 0.25), 0.2, place).front());
    }
    shapes.push_back({"islands in any order", islands});
    test::Rings triangles;
    for (int i = 39; i >= 0; --i) {
        const double x = 0.2 * (i % 8) - 0.8;
        const double y = 0.3 * (i / 8) - 0.7;
        triangles.push_back({{x, y}, {x + 0.1, y}, {x, y + 0.2}});
    }
    shapes.push_back({"many rings of few edges", triangles});
    // Three walls on one line: over different intervals an odd number of them or two coincide.
    shapes.push_back(
        {"walls on each other",
         {rectangle({0.0, 0.0}, {0.8, 0.2}).front(), rectangle({0.2, 0.0}, {1.0, 0.4}).front(),
          rectangle({-0.2, 0.0}, {0.6, 0.6}).front()}});
    return shapes;
}

inline geometry::Polygon polygon(const test::Rings& rings) {
    geometry::Polygon polygon;
    const Status status = polygon.assign(rings);
    if (!status.ok()) {
        throw std::invalid_argument(status.text());
    }
    return polygon;
}

}  // namespace nearfield::samples
