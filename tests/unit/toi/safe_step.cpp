#include <engine/geometry/segment.hpp>
#include <engine/toi/conservative_advancement.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nearfield::toi {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// Two polygons that move.
struct Moving {
    Polygon a;
    Polygon b;
    Pose start_a;
    Pose end_a;
    Pose start_b;
    Pose end_b;

    [[nodiscard]] Motion of_a() const { return {a, start_a, end_a}; }
    [[nodiscard]] Motion of_b() const { return {b, start_b, end_b}; }
};

std::vector<Vector> vertices_at(const Motion& motion, double time) {
    const geometry::TransformedPolygon placed(motion.polygon(), motion.at(time));
    std::vector<Vector> vertices;
    for (std::uint32_t i = 0; i < motion.polygon().vertices().size(); ++i) {
        vertices.push_back(placed.vertex(i));
    }
    return vertices;
}

/// The distance of the boundaries of polygons of one ring, by brute force.
double distance_at(const Motion& a, const Motion& b, double time) {
    const std::vector<Vector> of_a = vertices_at(a, time);
    const std::vector<Vector> of_b = vertices_at(b, time);
    double squared = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < of_a.size(); ++i) {
        for (std::size_t k = 0; k < of_b.size(); ++k) {
            squared = std::min(squared,
                               geometry::closest_of_segments(of_a[i], of_a[(i + 1) % of_a.size()],
                                                             of_b[k], of_b[(k + 1) % of_b.size()])
                                   .squared_distance);
        }
    }
    return std::sqrt(squared);
}

/// The time of the first step from 0: that after which a search of two queries has arrived.
Impact after_one_step(const Moving& pair, double contact_distance = 0.0) {
    const Motion a = pair.of_a();
    const Motion b = pair.of_b();
    ConservativeAdvancement finder;
    return finder.find(a, b, {1e-9, 1.0, 2, contact_distance});
}

Polygon square(double half) {
    return samples::polygon(test::rectangle({-half, -half}, {half, half}));
}

TEST(SafeStep, OfATranslationLeavesAnEighthOfTheDistance) {
    Moving pair{square(1.0), square(1.0), {{-3.0, 0.3}, 0.0}, {{7.0, 0.3}, 0.0}, {}, {}};
    // 1 apart, 10 towards each other.
    EXPECT_NEAR(after_one_step(pair).time, 7.0 / 8.0 / 10.0, 1e-9);
    // Of a quarter that shapes keep, the rest is divided.
    EXPECT_NEAR(after_one_step(pair, 0.25).time, 7.0 / 8.0 * 0.75 / 10.0, 1e-9);
    // Both move.
    pair.end_b = {{-5.0, 0.0}, 0.0};
    EXPECT_NEAR(after_one_step(pair).time, 7.0 / 8.0 / 15.0, 1e-9);
    // Whatever goes away never touches.
    pair.end_b = {{12.0, 0.0}, 0.0};
    EXPECT_EQ(after_one_step(pair).kind, Impact::Kind::none);
}

TEST(SafeStep, OfMorePairsThanAreTestedStopsShortOfTheOthers) {
    constexpr double distance = 0.01;         // of a leg from the floor
    constexpr double keep = distance / 8.0;   // what a step leaves
    constexpr double reach = 4.0 * distance;  // of the pairs that are tested
    constexpr double to_wall = reach + keep / 2.0;
    // A row of vertices above the floor, too many to test, once the reach grows to them.
    Ring ring{{-1.0, 1.0}, {-1.0, 0.0}, {-0.9, 0.0}, {-0.9, 0.09}};
    constexpr int many = 400;
    for (int i = 1; i < many; ++i) {
        ring.push_back({-0.9 + 1.9 * i / many, 0.09});
    }
    ring.insert(ring.end(), {{1.0, 0.09}, {1.0, 1.0}});
    const double wall = 1.0 + to_wall;
    const Moving pair{
        samples::polygon({ring}),
        samples::polygon(
            {{{-10.0, -1.0}, {10.0, -1.0}, {10.0, 4.0}, {wall, 4.0}, {wall, 0.0}, {-10.0, 0.0}}}),
        {{0.0, distance}, 0.0},
        {{1.0, distance}, 0.0},
        {},
        {}};
    const Impact impact = after_one_step(pair);
    EXPECT_NEAR(impact.time, reach - keep, 1e-9);
    EXPECT_GE(distance_at(pair.of_a(), pair.of_b(), impact.time), keep);
}

Polygon any_moving_polygon(test::Random& random) {
    const double size = random.between(0.02, 1.0);
    const test::Rings rings = random.below(2) == 0 ? test::star(random, random.whole(3, 6), 0.3)
                                                   : test::rectangle({-1.0, -0.1}, {1.0, 0.1});
    // Often far from the point that it turns about.
    const double arm = random.below(3) == 0 ? 0.0 : 4.0;
    return samples::polygon(test::scaled_and_moved(
        rings, size, {random.between(-arm, arm), random.between(-arm, arm)}));
}

Moving any_pair(test::Random& random) {
    const auto pose = [&random](double turn) {
        return Pose{{random.between(-4.0, 4.0), random.between(-4.0, 4.0)},
                    random.below(4) == 0 ? 0.0 : random.between(-turn, turn)};
    };
    return {any_moving_polygon(random),
            any_moving_polygon(random),
            pose(3.0),
            pose(9.0),
            pose(3.0),
            pose(9.0)};
}

TEST(SafeStep, IsNeverTooLongForAnyMotion) {
    test::Random random(501);
    int moved = 0;
    for (int i = 0; i < 6000; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const Moving pair = any_pair(random);
        const double keep = i % 3 == 0 ? 0.1 : 0.0;
        const Impact impact = after_one_step(pair, keep);
        if (impact.kind == Impact::Kind::at_start || impact.time == 0.0) {
            continue;
        }
        ++moved;
        const Motion a = pair.of_a();
        const Motion b = pair.of_b();
        const double kept = keep + (distance_at(a, b, 0.0) - keep) / 8.0;
        constexpr int looks = 48;
        for (int k = 0; k <= looks; ++k) {
            const double time = impact.time * k / looks;
            ASSERT_GE(distance_at(a, b, time), kept - 1e-9)
                << "at " << time << " of a step of " << impact.time;
        }
    }
    EXPECT_GT(moved, 3000);
}

TEST(SafeStep, ACertifiedDistanceIsKeptUntilTheContact) {
    test::Random random(502);
    ConservativeAdvancement finder;
    int hits = 0;
    for (int i = 0; i < 800; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const Moving pair = any_pair(random);
        const Motion a = pair.of_a();
        const Motion b = pair.of_b();
        const Impact impact = finder.find(a, b, {1e-4, 1.0, 1000, 0.0});
        if (impact.kind == Impact::Kind::at_start) {
            continue;
        }
        hits += impact.kind == Impact::Kind::found ? 1 : 0;
        double least = std::numeric_limits<double>::infinity();
        constexpr int looks = 400;
        for (int k = 0; k <= looks; ++k) {
            least = std::min(least, distance_at(a, b, impact.time * k / looks));
        }
        ASSERT_GE(least, impact.min_distance);
        ASSERT_GT(least, 0.0);
        if (impact.touch_at_latest && impact.latest < 1.0) {
            EXPECT_LE(distance_at(a, b, impact.time), 1e-4 + impact.rounding);
        }
    }
    EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace nearfield::toi
