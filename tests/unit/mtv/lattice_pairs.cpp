// Shapes on a common lattice, coincident edges included, anywhere in the world: different ones, and
// shapes against themselves, shifted by multiples of their own coordinates, so that vertices lie on
// edges, and edges on edges. Held against exact Minkowski differences.

#include <engine/mtv/separating_translation.hpp>

#include <gtest/gtest.h>
#include <tests/unit/mtv/exact_difference.hpp>
#include <tests/unit/mtv/lattice_shapes.hpp>
#include <tests/unit/support/placed_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::mtv {
namespace {

using namespace exact;

/// Divides every edge into equal parts, so that the same shape has many edges.
test::Rings divided(const test::Rings& rings, std::uint32_t parts) {
    test::Rings divided;
    for (const Ring& ring : rings) {
        Ring& fine = divided.emplace_back();
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2 from = ring[i];
            const Vector2 to = ring[(i + 1) % ring.size()];
            for (std::uint32_t k = 0; k < parts; ++k) {
                const double part = static_cast<double>(k) / parts;
                fine.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
            }
        }
    }
    return divided;
}

/// Where the lattice lies, in how many parts each edge is, and how much work a search may take.
struct Place {
    Frame frame;
    double offset = 0.0;  ///< of its origin, both coordinates
    Point shift;          ///< of A, by its pose
    std::uint32_t parts = 1;
    std::uint64_t max_work = default_work;
};

/// A bar with three teeth that point up or down, `gap` apart.
Shape comb(std::int64_t tooth, std::int64_t gap, bool up) {
    const std::int64_t high = up ? 30 : -30;
    std::vector<Point> ring{{0, up ? -3 : 3}};
    for (std::int64_t x : {std::int64_t{0}, tooth + gap, 2 * (tooth + gap)}) {
        ring.insert(ring.end(), {{x, 0}, {x, high}, {x + tooth, high}, {x + tooth, 0}});
    }
    ring.push_back({3 * tooth + 2 * gap, up ? -3 : 3});
    return {ring};
}

Shape any_lattice_shape(test::Random& random) {
    const std::vector<Shape> aligned = aligned_shapes();
    // The first one is large, which leaves little room for others beside it.
    return random.below(2) == 0
               ? aligned[1 + random.below(static_cast<std::uint32_t>(aligned.size()) - 1)]
               : lattice_star(random);
}

SeparatingTranslation find(const Shape& a, const Shape& b, const Place& place, double tolerance,
                           SeparatingTranslationFinder& finder) {
    const geometry::Polygon polygon_a =
        samples::polygon(divided(scaled(a, place.frame.scale), place.parts));
    const geometry::Polygon polygon_b =
        samples::polygon(divided(scaled(b, place.frame.scale), place.parts));
    const geometry::Vector by =
        place.frame.scale *
        (Eigen::Rotation2Dd(place.frame.angle) *
         geometry::Vector(static_cast<double>(place.shift.x), static_cast<double>(place.shift.y)));
    const Pose pose_a{{place.offset + by.x(), place.offset + by.y()}, place.frame.angle};
    const samples::PlacedPair pair(polygon_a, pose_a, &a == &b ? polygon_a : polygon_b,
                                   {{place.offset, place.offset}, place.frame.angle});
    return finder.find(pair.a(), pair.b(), pose_a, {tolerance, place.max_work});
}

struct Counts {
    int intersect = 0;
    int used_up = 0;
};

void check(const Shape& a, const Shape& b, const Place& place, SeparatingTranslationFinder& finder,
           Counts& counts) {
    const double tolerance = 1e-4 * place.frame.scale;
    const SeparatingTranslation way = find(a, b, place, tolerance, finder);
    const Difference difference(shifted(a, place.shift), b);
    const double truth = place.frame.scale * difference.shortest();
    // Far from the origin, coordinates are multiples of larger steps.
    const double rounding =
        1e-9 * place.frame.scale + 256.0 * std::numeric_limits<double>::epsilon() * place.offset;
    if (!way.intersect) {
        EXPECT_LE(truth, rounding);
        return;
    }
    ++counts.intersect;
    const double length = way.vector.norm();
    EXPECT_GE(length, truth - rounding);
    EXPECT_LE(way.lower_bound, truth + rounding);
    EXPECT_LE(way.lower_bound, length);
    if (place.frame.scale == 1.0 && place.frame.angle == 0.0) {
        EXPECT_TRUE(difference.separates(way.vector.x(), way.vector.y()));
    }
    Place of_back = place;
    of_back.shift = {-place.shift.x, -place.shift.y};
    const SeparatingTranslation back = find(b, a, of_back, tolerance, finder);
    EXPECT_TRUE(back.intersect);
    EXPECT_GE(back.vector.norm(), truth - rounding);
    EXPECT_LE(back.lower_bound, truth + rounding);
    if (std::max(way.work, back.work) >= place.max_work) {
        counts.used_up += place.max_work == default_work ? 1 : 0;
        return;
    }
    EXPECT_LE(length, truth + tolerance + rounding);
    EXPECT_LE(back.vector.norm(), truth + tolerance + rounding);
    EXPECT_GE(way.lower_bound, length - tolerance);
}

TEST(LatticePairs, HaveTheLengthsOfExactDifferences) {
    test::Random random(706);
    SeparatingTranslationFinder finder;
    Counts counts;
    const std::uint32_t pairs = number_of_pairs(400);
    for (std::uint32_t i = 0; i < pairs; ++i) {
        const auto step = [&] { return static_cast<std::int64_t>(random.below(9)) - 4; };
        // The teeth of every eighth pair fit into the gaps, with room on the lattice or with none.
        const bool combs = i % 8 == 0;
        const std::int64_t tooth = 5 + random.below(10);
        const std::int64_t gap = tooth + random.below(3);
        const Shape a =
            combs ? shifted(comb(tooth, gap, false), {0, 20}) : any_lattice_shape(random);
        const Shape b =
            shifted(combs ? comb(tooth, gap, true) : any_lattice_shape(random), {step(), step()});
        const Place places[] = {
            {{1.0, 0.0}, 0.0, {}, 1},  {{1.0, 0.5 * std::numbers::pi}, 1e6, {}, 1},
            {{1e-7, 0.7}, 0.0, {}, 1}, {{1e6, 2.5}, 0.0, {}, 1},
            {{1.0, 0.0}, 0.0, {}, 64}, {{1.0 / 3.0, 0.7}, 10.0, {}, 64},
        };
        // The many edges of the last take longer.
        Place place = places[random.below(random.below(4) == 0 ? 6 : 4)];
        // Work that runs out in the midst of the search leaves a bound that holds.
        if (random.below(4) == 0) {
            place.max_work = static_cast<std::uint64_t>(std::pow(10.0, random.between(3.0, 6.0)));
        }
        SCOPED_TRACE("pair " + std::to_string(i) + ", scale " + std::to_string(place.frame.scale) +
                     ", angle " + std::to_string(place.frame.angle) + ", in " +
                     std::to_string(place.parts) + " parts");
        check(a, b, place, finder, counts);
    }
    RecordProperty("intersect", counts.intersect);
    RecordProperty("used_up", counts.used_up);
    EXPECT_GE(counts.intersect, static_cast<int>(pairs / 3));
    EXPECT_LE(counts.used_up, static_cast<int>(pairs / 100));
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
        check(shape, shape, {}, finder, counts);
    }
    EXPECT_EQ(counts.intersect, static_cast<int>(aligned_shapes().size()));
    EXPECT_EQ(counts.used_up, 0);
}

TEST(SelfDifferences, OfShiftsByTheirOwnCoordinates) {
    test::Random random(705);
    const std::vector<Shape> aligned = aligned_shapes();
    SeparatingTranslationFinder finder;
    Counts counts;
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
        check(shape, shape, {.frame = frame, .shift = shift}, finder, counts);
    }
    RecordProperty("intersect", counts.intersect);
    RecordProperty("used_up", counts.used_up);
    EXPECT_GE(counts.intersect, static_cast<int>(pairs / 3));
    EXPECT_LE(counts.used_up, static_cast<int>(pairs / 100));
}

}  // namespace
}  // namespace nearfield::mtv
