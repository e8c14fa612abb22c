#include <engine/geometry/recently_placed.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <vector>

namespace nearfield::geometry {
namespace {

using test::Random;

void expect_same(const BoxedPolygon& found, const BoxedPolygon& expected) {
    EXPECT_EQ(&found.placed.polygon(), &expected.placed.polygon());
    EXPECT_EQ(found.placed.rotation(), expected.placed.rotation());
    EXPECT_EQ(found.placed.translation(), expected.placed.translation());
    EXPECT_EQ(found.box.min(), expected.box.min());
    EXPECT_EQ(found.box.max(), expected.box.max());
}

// Far more instances than are remembered, of shapes that change in between.
TEST(RecentlyPlaced, IsWhatIsPlacedAnew) {
    Random random(31);
    std::vector<Polygon> polygons(5);
    for (Polygon& polygon : polygons) {
        ASSERT_TRUE(polygon.assign(test::star(random, 20, 0.3)).ok());
    }
    std::vector<Pose> poses;
    for (int i = 0; i < 40; ++i) {
        poses.push_back(
            {{random.between(-1.0, 1.0), random.between(-1.0, 1.0)}, random.between(-3.0, 3.0)});
    }
    RecentlyPlaced recent(16);
    const auto any = [&random](const auto& all) -> const auto& {
        return all[static_cast<std::size_t>(random.whole(0, static_cast<int>(all.size()) - 1))];
    };
    for (int i = 0; i < 5000; ++i) {
        const Polygon& polygon = any(polygons);
        const Pose& pose = any(poses);
        if (i % 50 == 0) {
            ASSERT_TRUE(polygons[2].assign(test::star(random, 20, 0.3)).ok());
        }
        const BoxedPolygon expected(polygon, pose);
        expect_same(recent.place(polygon, pose), expected);
    }
}

// Poses that differ in one number, or in the sign of zero.
TEST(RecentlyPlaced, TellsPosesApart) {
    Polygon polygon;
    ASSERT_TRUE(polygon.assign(test::rectangle({0.0, 0.0}, {2.0, 1.0})).ok());
    RecentlyPlaced recent(1);
    const std::vector<Pose> poses{{{0.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0},  {{0.0, 1.0}, 0.0},
                                  {{0.0, 0.0}, 1.0}, {{-0.0, 0.0}, 0.0}, {{0.0, 0.0}, -0.0}};
    for (const Pose& pose : poses) {
        for (const Pose& other : poses) {
            static_cast<void>(recent.place(polygon, other));
            expect_same(recent.place(polygon, pose), BoxedPolygon(polygon, pose));
        }
    }
}

}  // namespace
}  // namespace nearfield::geometry
