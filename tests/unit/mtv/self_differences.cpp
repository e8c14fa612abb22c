// Shapes against themselves, shifted by multiples of their own coordinates: vertices lie on edges,
// and edges on edges. Held against exact Minkowski differences.

#include <engine/mtv/separating_translation.hpp>

#include <gtest/gtest.h>
#include <tests/unit/mtv/exact_difference.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace nearfield::mtv {
namespace {

using exact::Point;
using exact::Shape;

constexpr std::uint64_t default_work = 10'000'000;  // SeparationVectorQuery::max_work

std::uint32_t number_of_pairs() {
    const char* const cases = std::getenv("NEARFIELD_TEST_CASES");
    return cases == nullptr ? 1'000U : static_cast<std::uint32_t>(std::atoi(cases));
}

std::vector<Shape> aligned_shapes() {
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
Shape lattice_star(samples::Random& random) {
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

Shape shifted(Shape shape, const Point& by) {
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

samples::Rings scaled(const Shape& shape, double scale) {
    samples::Rings rings;
    for (const std::vector<Point>& ring : shape) {
        Ring& scaled = rings.emplace_back();
        for (const Point& point : ring) {
            scaled.push_back(
                {scale * static_cast<double>(point.x), scale * static_cast<double>(point.y)});
        }
    }
    return rings;
}

struct Counts {
    int intersect = 0;
    int used_up = 0;
};

void check(const Shape& shape, const Point& shift, const Frame& frame,
           SeparatingTranslationFinder& finder, Counts& counts) {
    const geometry::Polygon polygon = samples::polygon(scaled(shape, frame.scale));
    const geometry::Vector by = frame.scale * (Eigen::Rotation2Dd(frame.angle) *
                                               geometry::Vector(static_cast<double>(shift.x),
                                                                static_cast<double>(shift.y)));
    const Pose pose_a{{by.x(), by.y()}, frame.angle};
    simd::TransformedInstances instances;
    const std::uint32_t a = instances.place(polygon, pose_a);
    const std::uint32_t b = instances.place(polygon, {{}, frame.angle});
    const double tolerance = 1e-4 * frame.scale;
    const SeparatingTranslation way =
        finder.find(instances[a], instances[b], pose_a, {tolerance, default_work});
    const exact::Difference difference(shifted(shape, shift), shape);
    const double truth = frame.scale * difference.shortest();
    const double rounding = 1e-9 * frame.scale;
    const double length = way.vector.norm();
    if (!way.intersect) {
        EXPECT_EQ(truth, 0.0);
        return;
    }
    ++counts.intersect;
    EXPECT_GE(length, truth - rounding);
    EXPECT_LE(way.lower_bound, truth + rounding);
    EXPECT_LE(way.lower_bound, length);
    if (way.work >= default_work) {
        ++counts.used_up;
    } else {
        EXPECT_LE(length, truth + tolerance);
        EXPECT_GE(way.lower_bound, length - tolerance);
    }
    if (frame.scale == 1.0 && frame.angle == 0.0) {
        EXPECT_TRUE(difference.separates(way.vector.x(), way.vector.y()));
    }
}

TEST(SelfDifferences, TheOracleKnowsSquares) {
    const Shape square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
    EXPECT_EQ(exact::Difference(square, square).shortest(), 4.0);
    EXPECT_EQ(exact::Difference(shifted(square, {3, 2}), square).shortest(), 1.0);
    EXPECT_EQ(exact::Difference(shifted(square, {4, 2}), square).shortest(), 0.0);
    // Into the hole, which is larger by one on each side, or just as large.
    const Shape frame{{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
    EXPECT_EQ(exact::Difference(shifted(square, {1, -2}), frame).shortest(), 2.0);
    const Shape tight{{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
    EXPECT_EQ(exact::Difference(square, tight).shortest(), 9.0);
    EXPECT_TRUE(exact::Difference(square, square).separates(4.0 + 1e-12, 1.0));
    EXPECT_FALSE(exact::Difference(square, square).separates(4.0 - 1e-12, 1.0));
}

TEST(SelfDifferences, OfShapesThatOnceWentWrong) {
    SeparatingTranslationFinder finder;
    Counts counts;
    for (const Shape& shape : aligned_shapes()) {
        check(shape, {}, {}, finder, counts);
    }
    EXPECT_EQ(counts.intersect, static_cast<int>(aligned_shapes().size()));
    EXPECT_EQ(counts.used_up, 0);
}

TEST(SelfDifferences, OfShiftsByTheirOwnCoordinates) {
    samples::Random random(705);
    const std::vector<Shape> aligned = aligned_shapes();
    SeparatingTranslationFinder finder;
    Counts counts;
    const std::uint32_t pairs = number_of_pairs();
    for (std::uint32_t i = 0; i < pairs; ++i) {
        const Shape shape = i % 2 == 0
                                ? aligned[random.below(static_cast<std::uint32_t>(aligned.size()))]
                                : lattice_star(random);
        const auto vertex = [&] {
            const auto& ring = shape[random.below(static_cast<std::uint32_t>(shape.size()))];
            return ring[random.below(static_cast<std::uint32_t>(ring.size()))];
        };
        const auto times = static_cast<std::int64_t>(random.below(3)) - 1;
        const Point one = vertex();
        const Point other = vertex();
        const Point third = vertex();
        const Point shift{times * (one.x - other.x), times * (one.y - third.y)};
        const double scales[] = {1.0, 1.0, 0.1, 1.0 / 3.0, 1e-3, 1e5};
        const double angles[] = {0.0, 0.0, 0.0, 0.5 * std::numbers::pi, 0.7};
        const Frame frame{scales[random.below(6)], angles[random.below(5)]};
        SCOPED_TRACE("pair " + std::to_string(i) + ", shifted by " + std::to_string(shift.x) + " " +
                     std::to_string(shift.y) + ", scale " + std::to_string(frame.scale) +
                     ", angle " + std::to_string(frame.angle));
        check(shape, shift, frame, finder, counts);
    }
    RecordProperty("intersect", counts.intersect);
    RecordProperty("used_up", counts.used_up);
    EXPECT_GE(counts.intersect, static_cast<int>(pairs / 3));
    EXPECT_LE(counts.used_up, static_cast<int>(pairs / 100));
}

}  // namespace
}  // namespace nearfield::mtv
