#include <engine/geometry/segment.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace nearfield::geometry {
namespace {

TEST(NearestOnSegment, NoSampleIsNearer) {
    test::Random random(1);
    for (int round = 0; round < 3000; ++round) {
        const double far = round % 3 == 0 ? 1e6 : 0.0;
        const double thin = round % 2 == 0 ? 1.0 : 1e-6;
        const auto point = [&] {
            return Vector(far + random.between(-1.0, 1.0), far + thin * random.between(-1.0, 1.0));
        };
        const Vector p = point();
        const Vector a = point();
        const Vector b = round % 7 == 0 ? a : point();
        const NearestOnSegment nearest = nearest_on_segment(p, a, b);
        ASSERT_GE(nearest.parameter, 0.0);
        ASSERT_LE(nearest.parameter, 1.0);
        const double rounding = 1e-15 * (1.0 + far);
        EXPECT_LE((nearest.point - (a + nearest.parameter * (b - a))).norm(), rounding) << round;
        const double distance = (nearest.point - p).norm();
        EXPECT_DOUBLE_EQ(nearest.squared_distance, distance * distance) << round;
        for (int i = 0; i <= 200; ++i) {
            EXPECT_LE(distance, (a + i / 200.0 * (b - a) - p).norm() + rounding) << round;
        }
    }
}

TEST(NearestOnSegment, EndsAreReturnedAsTheyAre) {
    const Vector a(0.1, 0.7);
    const Vector b(0.3, 1e6);
    EXPECT_EQ(nearest_on_segment(Vector(0.0, -5.0), a, b).point, a);
    EXPECT_EQ(nearest_on_segment(Vector(0.0, -5.0), a, b).parameter, 0.0);
    EXPECT_EQ(nearest_on_segment(Vector(0.0, 2e6), a, b).point, b);
    EXPECT_EQ(nearest_on_segment(Vector(0.0, 2e6), a, b).parameter, 1.0);
    EXPECT_EQ(nearest_on_segment(Vector(0.0, 2e6), a, a).point, a);
    EXPECT_EQ(nearest_on_segment(a, a, a).squared_distance, 0.0);
}

/// Twice the area of a triangle of lattice points, without rounding.
std::int64_t turn(const Vector& a, const Vector& b, const Vector& c) {
    const auto whole = [](double x) { return static_cast<std::int64_t>(x); };
    return whole(b.x() - a.x()) * whole(c.y() - a.y()) -
           whole(b.y() - a.y()) * whole(c.x() - a.x());
}

bool on_segment(const Vector& p, const Vector& a, const Vector& b) {
    return turn(a, b, p) == 0 && (p - a).dot(p - b) <= 0.0;
}

/// By cases: a proper crossing, or an end of one on the other.
bool intersect_by_cases(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    const auto opposite = [](std::int64_t x, std::int64_t y) {
        return (x > 0 && y < 0) || (x < 0 && y > 0);
    };
    return (opposite(turn(a, b, c), turn(a, b, d)) && opposite(turn(c, d, a), turn(c, d, b))) ||
           on_segment(a, c, d) || on_segment(b, c, d) || on_segment(c, a, b) || on_segment(d, a, b);
}

TEST(SegmentsIntersect, AllSegmentsOfASmallLattice) {
    // All ways to touch, overlap, cross or degenerate occur on a lattice of 4 x 3 points.
    for (const double far : {0.0, 1e6}) {
        std::vector<Vector> points;
        for (int x = 0; x < 4; ++x) {
            for (int y = 0; y < 3; ++y) {
                points.emplace_back(far + x, y - far);
            }
        }
        int together = 0;
        int apart = 0;
        for (const Vector& a : points) {
            for (const Vector& b : points) {
                for (const Vector& c : points) {
                    for (const Vector& d : points) {
                        const bool expected = intersect_by_cases(a, b, c, d);
                        ASSERT_EQ(segments_intersect(a, b, c, d), expected)
                            << a.transpose() << ", " << b.transpose() << " and " << c.transpose()
                            << ", " << d.transpose();
                        (expected ? together : apart) += 1;
                    }
                }
            }
        }
        EXPECT_GT(together, 1000);
        EXPECT_GT(apart, 1000);
    }
}

TEST(SegmentsMeet, WhereTheirDistanceIsWithinTheMargin) {
    test::Random random(3);
    int within = 0;
    int without = 0;
    for (int round = 0; round < 20000; ++round) {
        const Vector a(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        const Vector b(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        // Nearly parallel in every third round, so that they lie beside each other.
        const double gap = random.between(-0.2, 0.2);
        const double turn = round % 3 == 0 ? 0.01 : 1.0;
        const auto beside = [&](const Vector& p) {
            return Vector(p.x() - gap * (b - a).y() + turn * random.between(-0.5, 0.5),
                          p.y() + gap * (b - a).x() + turn * random.between(-0.5, 0.5));
        };
        const Vector c = beside(a);
        const Vector d = beside(b);
        const double margin = random.between(0.0, 0.2);
        const double distance = std::sqrt(closest_of_segments(a, b, c, d).squared_distance);
        if (std::abs(distance - margin) < 1e-9) {
            continue;
        }
        const bool expected = distance < margin;
        (expected ? within : without) += 1;
        EXPECT_EQ(segments_meet(a, b, c, d, margin), expected) << round;
        EXPECT_EQ(std::isfinite(first_meeting(a, b, c, d, margin)), expected) << round;
    }
    EXPECT_GT(within, 2000);
    EXPECT_GT(without, 2000);
}

/// Where along them almost parallel segments cross is uncertain; that the point is on both is not.
TEST(ClosestOfSegments, CrossInAPointOfBothIfAlmostParallel) {
    std::mt19937 random(28);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto any = [&](double most) {
        return Vector(most * uniform(random), most * uniform(random));
    };
    int crossings = 0;
    for (int i = 0; i < 20000; ++i) {
        const double off = std::pow(10.0, -10.0 + 4.0 * uniform(random));
        const Vector a = any(1.0);
        const Vector b = any(1.0);
        const Vector c = a + any(off);
        const Vector d = b + any(off);
        if (segments_intersect(a, b, c, d)) {
            const ClosestOfSegments closest = closest_of_segments(a, b, c, d);
            EXPECT_EQ(closest.squared_distance, 0.0);
            for (const Vector& point : {closest.first, closest.second}) {
                EXPECT_LT(nearest_on_segment(point, a, b).squared_distance, 1e-30);
                EXPECT_LT(nearest_on_segment(point, c, d).squared_distance, 1e-30);
            }
            ++crossings;
        }
    }
    EXPECT_GT(crossings, 4000);
}

TEST(ClosestOfSegments, AlongOneLineHaveACommonPoint) {
    int intersecting = 0;
    for (int i = 0; i < 2000; ++i) {
        const double angle = 0.00314 * i;
        const auto at = [&](double x) {
            return Vector(0.3 + x * std::cos(angle), 0.2 + x * std::sin(angle));
        };
        const auto check = [&](const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
            const ClosestOfSegments closest = closest_of_segments(a, b, c, d);
            EXPECT_LT(closest.squared_distance, 1e-28);
            intersecting += closest.squared_distance == 0.0 ? 1 : 0;
            EXPECT_LT(nearest_on_segment(closest.first, a, b).squared_distance, 1e-28) << i;
            EXPECT_LT(nearest_on_segment(closest.first, c, d).squared_distance, 1e-28) << i;
            EXPECT_LT(nearest_on_segment(closest.second, c, d).squared_distance, 1e-28) << i;
            EXPECT_LT((a + closest.first_parameter * (b - a) - closest.first).norm(), 1e-14);
            EXPECT_LT((c + closest.second_parameter * (d - c) - closest.second).norm(), 1e-14);
        };
        check(at(-2.0), at(2.0), at(-1.0), at(1.0));
        check(at(-1.0), at(1.0), at(-2.0), at(2.0));
        check(at(-2.0), at(1.0), at(2.0), at(-1.0));
    }
    EXPECT_GT(intersecting, 1000);
}

}  // namespace
}  // namespace nearfield::geometry
