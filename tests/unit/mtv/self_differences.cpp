// Shapes against themselves, shifted by multiples of their own coordinates: vertices lie on edges,
// and edges on edges. Held against exact Minkowski differences.

#include <engine/mtv/separating_translation.hpp>

#include <gtest/gtest.h>
#include <tests/unit/mtv/exact_difference.hpp>
#include <tests/unit/mtv/lattice_shapes.hpp>

#include <numbers>
#include <string>
#include <vector>

namespace nearfield::mtv {
namespace {

using namespace exact;

struct DifferenceCounts {
    int intersect = 0;
    int used_up = 0;
};

void check_difference(const Shape& shape, const Point& shift, const Frame& frame,
                      SeparatingTranslationFinder& finder, DifferenceCounts& counts) {
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
    DifferenceCounts counts;
    for (const Shape& shape : aligned_shapes()) {
        check_difference(shape, {}, {}, finder, counts);
    }
    EXPECT_EQ(counts.intersect, static_cast<int>(aligned_shapes().size()));
    EXPECT_EQ(counts.used_up, 0);
}

TEST(SelfDifferences, OfShiftsByTheirOwnCoordinates) {
    samples::Random random(705);
    const std::vector<Shape> aligned = aligned_shapes();
    SeparatingTranslationFinder finder;
    DifferenceCounts counts;
    const std::uint32_t pairs = number_of_pairs(1'000);
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
        check_difference(shape, shift, frame, finder, counts);
    }
    RecordProperty("intersect", counts.intersect);
    RecordProperty("used_up", counts.used_up);
    EXPECT_GE(counts.intersect, static_cast<int>(pairs / 3));
    EXPECT_LE(counts.used_up, static_cast<int>(pairs / 100));
}

}  // namespace
}  // namespace nearfield::mtv
