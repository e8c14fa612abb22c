#include <engine/geometry/transformed_polygon.hpp>
#include <engine/toi/swept_box.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

namespace nearfield::toi {
namespace {

using geometry::Box;
using geometry::Polygon;

Pose any_pose(test::Random& random, double scale) {
    return {{random.between(-scale, scale), random.between(-scale, scale)},
            random.below(4) == 0 ? 0.0 : random.between(-9.0, 9.0)};
}

TEST(SweptBox, HoldsThePolygonAtAllTimes) {
    test::Random random(512);
    for (int i = 0; i < 300; ++i) {
        const Polygon polygon = samples::polygon(
            test::scaled_and_moved(test::star(random, 7, 0.2), 1.0,
                                   {random.between(-9.0, 9.0), random.between(-9.0, 9.0)}));
        const double scale = random.below(3) == 0 ? 1e6 : 4.0;
        const Pose start = any_pose(random, scale);
        Pose end = any_pose(random, scale);
        if (random.below(3) == 0) {
            end.angle = start.angle;
        }
        const Motion motion(polygon, start, end);
        const Box box = swept_box(motion);
        for (int step = 0; step <= 100; ++step) {
            const Pose pose = motion.at(step / 100.0);
            ASSERT_TRUE(box.contains(geometry::TransformedPolygon(polygon, pose).box()))
                << i << ", step " << step;
        }
    }
}

TEST(SweptBox, IsTightForAStraightMotion) {
    const Polygon polygon = samples::polygon({{{0, 0}, {2, 0}, {2, 1}, {0, 1}}});
    const Box box = swept_box({polygon, {{0, 0}}, {{10, 5}}});
    EXPECT_NEAR(box.min().x(), 0.0, 1e-12);
    EXPECT_NEAR(box.min().y(), 0.0, 1e-12);
    EXPECT_NEAR(box.max().x(), 12.0, 1e-12);
    EXPECT_NEAR(box.max().y(), 6.0, 1e-12);
}

}  // namespace
}  // namespace nearfield::toi
