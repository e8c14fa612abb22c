#include <engine/narrowphase/containment_test.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using samples::Rings;

Ring box(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Whether A is inside B where both are moved and turned alike.
bool is_inside_at(const Rings& a, const Rings& b, const Pose& pose) {
    const Polygon polygon_a = samples::polygon(a);
    const Polygon polygon_b = samples::polygon(b);
    simd::TransformedInstances instances;
    const std::uint32_t index_a = instances.place(polygon_a, pose);
    const std::uint32_t index_b = instances.place(polygon_b, pose);
    instances.complete(index_a);
    instances.complete(index_b);
    ContainmentTest test;
    return test.is_inside(instances[index_a], instances[index_b]);
}

/// Whether A is inside B; the same wherever both are.
bool is_inside(const Rings& a, const Rings& b) {
    const bool answer = is_inside_at(a, b, {});
    for (const Pose& pose :
         {Pose{{3.0, -7.0}, 0.3}, Pose{{1e5, 2e5}, 2.0}, Pose{{0.1, 0.7}, std::numbers::pi}}) {
        EXPECT_EQ(is_inside_at(a, b, pose), answer) << "turned by " << pose.angle;
    }
    return answer;
}

// Unions of cells, whole shapes of all families and outlines are in tests/query.

const Ring room = box(0, 0, 10, 10);

TEST(ContainmentTest, SelfCrossingRingsFollowTheOddEvenRule) {
    const Ring bow_tie{{0, 0}, {10, 10}, {10, 0}, {0, 10}};
    EXPECT_TRUE(is_inside({box(1, 4, 2, 6)}, {bow_tie}));
    EXPECT_FALSE(is_inside({box(4, 1, 6, 2)}, {bow_tie}));
    EXPECT_TRUE(is_inside({bow_tie}, {room}));
    EXPECT_FALSE(is_inside({room}, {bow_tie}));
    Ring pentagram;
    for (int i = 0; i < 5; ++i) {
        const double angle = 4.0 * std::numbers::pi * i / 5.0;
        pentagram.push_back({10.0 * std::cos(angle), 10.0 * std::sin(angle)});
    }
    EXPECT_FALSE(is_inside({box(-1, -1, 1, 1)}, {pentagram}));  // its middle is outside
    EXPECT_TRUE(is_inside({box(6, -0.1, 7, 0.1)}, {pentagram}));
    EXPECT_FALSE(is_inside({box(2, -0.1, 7, 0.1)}, {pentagram}));
}

TEST(ContainmentTest, LinesWithoutAreaCountAsPointsOfTheirShape) {
    const Ring spiked{{1, 1}, {9, 1}, {9, 5}, {12, 5}, {9, 5}, {9, 9}, {1, 9}};
    EXPECT_FALSE(is_inside({spiked}, {room}));  // the spike reaches out of the room
    EXPECT_TRUE(is_inside({spiked}, {spiked}));
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9)}, {spiked}));
    // Along the lower sides of two parcels, across the gap between them.
    const Ring along{{1, 0}, {7, 0}, {3, 0}, {3, 5}, {1, 5}};
    EXPECT_FALSE(is_inside({along}, {box(0, 0, 4, 6), box(6, 0, 10, 6)}));
    EXPECT_TRUE(is_inside({along}, {box(0, 0, 4, 6), box(4, 0, 10, 6)}));
    const Ring inward{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {10, 5}, {10, 10}, {0, 10}};
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9)}, {inward}));  // both sides of the spike are inside
}

}  // namespace
}  // namespace nearfield::narrowphase
