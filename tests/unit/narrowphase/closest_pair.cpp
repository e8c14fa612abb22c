#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/overlap_test.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/unit/support/placed_shapes.hpp>

#include <cmath>
#include <limits>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;
using samples::PlacedPair;

constexpr double infinity = std::numeric_limits<double>::infinity();

double brute_force_squared_distance(const TransformedPolygon& a, const TransformedPolygon& b) {
    double least = infinity;
    for (std::uint32_t i = 0; i < a.polygon().size(); ++i) {
        for (std::uint32_t j = 0; j < b.polygon().size(); ++j) {
            least = std::min(
                least, geometry::closest_of_segments(a.vertex(i), a.vertex(a.polygon().next(i)),
                                                     b.vertex(j), b.vertex(b.polygon().next(j)))
                           .squared_distance);
        }
    }
    return least;
}

TEST(ClosestOfSegments, NoSampleIsCloser) {
    test::Random random(8);
    for (int round = 0; round < 2000; ++round) {
        const auto point = [&] {
            return Vector(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        };
        const Vector a = point();
        const Vector b = round % 9 == 0 ? a : point();
        const Vector c = point();
        const Vector d = round % 5 == 0 ? Vector(c + 0.7 * (b - a)) : point();  // parallel
        const auto closest = geometry::closest_of_segments(a, b, c, d);
        EXPECT_LT((a + closest.first_parameter * (b - a) - closest.first).norm(), 1e-15);
        EXPECT_LT((c + closest.second_parameter * (d - c) - closest.second).norm(), 1e-14);
        const double distance = std::sqrt(closest.squared_distance);
        EXPECT_NEAR((closest.first - closest.second).norm(), distance, 1e-15);
        for (int i = 0; i <= 20; ++i) {
            const Vector p = a + i / 20.0 * (b - a);
            EXPECT_LE(closest.squared_distance,
                      geometry::nearest_on_segment(p, c, d).squared_distance + 1e-15);
        }
        EXPECT_EQ(closest.squared_distance,
                  geometry::closest_of_segments(c, d, a, b).squared_distance);
    }
}

TEST(OverlapTest, ShapesThatTouchUpToRoundingMeet) {
    const Polygon square = samples::polygon(test::rectangle({-0.5, -0.5}, {0.5, 0.5}));
    OverlapTest overlap_test;
    for (const double far : {0.0, 1e3, 1e6}) {
        const PlacedPair one(square, {{far, far}, 0.0}, square, {{far + 1.0, far}, 0.0});
        const double rounding = one.a().rounding + one.b().rounding;
        const PlacedPair near(square, {{far, far}, 0.0}, square,
                              {{far + 1.0 + 0.5 * rounding, far}, 0.0});
        ASSERT_FALSE(near.a().box.intersects(near.b().box));
        EXPECT_TRUE(overlap_test.intersect(near.a(), near.b())) << far;
        const PlacedPair apart(square, {{far, far}, 0.0}, square,
                               {{far + 1.0 + 9.0 * rounding, far}, 0.0});
        EXPECT_FALSE(overlap_test.intersect(apart.a(), apart.b())) << far;
    }
}

/// A rectangle whose upper and lower sides are divided into `edges` edges.
Ring cut_rectangle(double low_x, double low_y, double high_x, double high_y, int edges) {
    Ring ring;
    for (int i = 0; i < edges; ++i) {
        ring.push_back({low_x + (high_x - low_x) * i / edges, low_y});
    }
    for (int i = 0; i < edges; ++i) {
        ring.push_back({high_x - (high_x - low_x) * i / edges, high_y});
    }
    ring.push_back({low_x, high_y});
    return ring;
}

/// Tens of thousands of pairs as close as the closest, up to the margin: more than are stored.
TEST(ClosestPair, UniqueUnlessAnotherIsAsCloseAmongVeryMany) {
    const Polygon wall = samples::polygon({cut_rectangle(0.0, 0.0, 10.0, 1.0, 1500)});
    ClosestPairFinder finder;
    const auto unique = [&](const Ring& ring, double margin) {
        const Polygon polygon = samples::polygon({ring});
        const PlacedPair placed(wall, {}, polygon, {});
        const ClosestPair closest = finder.find(placed.a(), placed.b(), infinity, margin);
        EXPECT_EQ(closest.squared_distance,
                  brute_force_squared_distance(placed.a().placed, placed.b().placed));
        return finder.is_unique(closest, Side::either, margin, 0.5);
    };
    for (const double margin : {0.0, 1e-3}) {
        EXPECT_TRUE(unique(cut_rectangle(5.0, 2.0, 5.4, 4.0, 500), margin));
        EXPECT_FALSE(unique(cut_rectangle(5.0, 2.0, 6.0, 4.0, 500), margin));
    }
    // Tilted down to the left, so that the other end is farther away by 0.001.
    Ring tilted = cut_rectangle(5.0, 2.0, 7.0, 4.0, 500);
    for (Vector2& vertex : tilted) {
        vertex.y += 5e-4 * (vertex.x - 5.0);
    }
    EXPECT_TRUE(unique(tilted, 1e-4));
    EXPECT_FALSE(unique(tilted, 5e-4));
}

void expect_equal(const ClosestPair& found, const ClosestPair& expected) {
    EXPECT_EQ(found.edge_a, expected.edge_a);
    EXPECT_EQ(found.edge_b, expected.edge_b);
    EXPECT_EQ(found.point_a, expected.point_a);
    EXPECT_EQ(found.point_b, expected.point_b);
    EXPECT_EQ(found.squared_distance, expected.squared_distance);
}

TEST(ClosestPair, OfFewEdgesIsTheSameInAnyDirectionOnEveryInstructionSet) {
    test::Random random(92);
    ClosestPairFinder finder;
    for (int i = 0; i < 400; ++i) {
        const Polygon a = samples::polygon(test::star(random, random.whole(3, 32), 0.3));
        const double inner = random.between(0.1, 0.9);
        const Polygon b = samples::polygon(test::star(random, random.whole(3, 19), inner));
        const double away = i % 4 == 0 ? 3e7 : 1.0;
        const double turn = random.between(0.0, 6.0);
        const PlacedPair pair(a, {{away, -away}, turn}, b,
                              {{away + 2.01 * std::cos(turn), -away + 2.01 * std::sin(turn)},
                               random.between(0.0, 6.0)});
        const ClosestPair expected = finder.find(pair.a(), pair.b(), 10.0, 0.0);
        const Vector towards = (expected.point_b - expected.point_a).stableNormalized();
        const Vector beside(-towards.y(), towards.x());
        for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
            hwy::SetSupportedTargetsForTest(left & ~(left - 1));
            hwy::GetChosenTarget().DeInit();
            for (const Vector& direction :
                 {Vector(0.0, 0.0), Vector(0.999 * towards), beside, Vector(-0.5 * towards),
                  Vector(1.0, 0.0), Vector(0.0, -1.0)}) {
                for (const double at_most : {10.0, 1.0001 * std::sqrt(expected.squared_distance)}) {
                    expect_equal(
                        finder.find_of_few(pair.a(), pair.b(), pair.b().tree(), at_most, direction),
                        expected);
                }
            }
            hwy::SetSupportedTargetsForTest(0);
            hwy::GetChosenTarget().DeInit();
        }
    }
}

}  // namespace
}  // namespace nearfield::narrowphase
