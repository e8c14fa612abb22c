#pragma once

#include <tests/unit/mtv/exact_difference.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

/// Shapes with integer coordinates, for exact::Difference.
namespace nearfield::mtv::exact {

inline constexpr std::uint64_t default_work = 10'000'000;  // SeparationVectorQuery::max_work

/// How many pairs to try: NEARFIELD_TEST_CASES if it is set.
inline std::uint32_t number_of_pairs(std::uint32_t usual) {
    const char* const cases = std::getenv("NEARFIELD_TEST_CASES");
    return cases == nullptr ? usual : static_cast<std::uint32_t>(std::atoi(cases));
}

inline std::vector<Shape> aligned_shapes() {
    return {
        {{{10, 10}, {60, 100}, {110, 10}}},
        {{{0, 0}, {4, 0}, {4, 5}, {3, 5}, {3, 2}, {2, 2}, {2, 5}, {1, 5}, {1, 2}, {0, 2}}},
        {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}},
        {{{0, 0}, {6, 0}, {6, 1}, {1, 1}, {1, 6}, {0, 6}}},
        {{{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}},
        {{{1, 0},
          {2, 0},
          {2, 1},
          {3, 1},
          {3, 2},
          {2, 2},
          {2, 3},
          {1, 3},
          {1, 2},
          {0, 2},
          {0, 1},
          {1, 1}}},
        {{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {6, 3}, {6, 6}, {3, 6}}},
        {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{4, 0}, {6, 0}, {6, 2}, {4, 2}}},
        {{{0, 0}, {3, 1}, {6, 0}, {5, 3}, {6, 6}, {3, 5}, {0, 6}, {1, 3}}},
        {{{0, 0},
          {7, 0},
          {7, 7},
          {1, 7},
          {1, 3},
          {4, 3},
          {4, 4},
          {2, 4},
          {2, 6},
          {6, 6},
          {6, 1},
          {0, 1}}},
        {{{0, 0}, {4, 4}, {4, 0}, {0, 4}}},
    };
}

/// Vertices in random directions from the origin, on a lattice.
inline Shape lattice_star(test::Random& random) {
    const std::uint32_t size = 3 + random.below(5);
    const std::int64_t most = random.below(2) == 0 ? 4 : 20;
    std::vector<Point> ring;
    for (std::uint32_t i = 0; i < size; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / size;
        const double radius = random.between(0.3, 1.0) * static_cast<double>(most);
        const Point point{std::llround(radius * std::cos(angle)),
                          std::llround(radius * std::sin(angle))};
        if (ring.empty() || point.x != ring.back().x || point.y != ring.back().y) {
            ring.push_back(point);
        }
    }
    while (ring.size() < 3 || (ring[0].x == ring.back().x && ring[0].y == ring.back().y)) {
        ring.push_back({most, most + static_cast<std::int64_t>(ring.size())});
    }
    return {ring};
}

inline Shape shifted(Shape shape, const Point& by) {
    for (std::vector<Point>& ring : shape) {
        for (Point& point : ring) {
            point = {point.x + by.x, point.y + by.y};
        }
    }
    return shape;
}

/// How the lattice lies in the world.
struct Frame {
    double scale = 1.0;
    double angle = 0.0;
};

inline test::Rings scaled(const Shape& shape, double scale) {
    test::Rings rings;
    for (const std::vector<Point>& ring : shape) {
        Ring& scaled = rings.emplace_back();
        for (const Point& point : ring) {
            scaled.push_back(
                {scale * static_cast<double>(point.x), scale * static_cast<double>(point.y)});
        }
    }
    return rings;
}

}  // namespace nearfield::mtv::exact
