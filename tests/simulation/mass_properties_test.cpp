#include <gtest/gtest.h>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>

#include <algorithm>
#include <vector>

namespace nearfield::test {
namespace {

using simulation::mass_properties;
using simulation::MassProperties;

Ring rectangle(Vector2 low, Vector2 high) {
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

double rectangle_inertia(double width, double height) {
    return width * height * (width * width + height * height) / 12.0;
}

TEST(MassProperties, OfARectangleFarAwayInEitherOrientation) {
    std::vector<Ring> rings{rectangle({1e6, -2e6}, {1e6 + 3.0, -2e6 + 2.0})};
    for (int turn = 0; turn < 2; ++turn) {
        const MassProperties plate = mass_properties(rings);
        EXPECT_NEAR(plate.area, 6.0, 1e-9);
        EXPECT_NEAR(plate.centroid.x, 1e6 + 1.5, 1e-9);
        EXPECT_NEAR(plate.centroid.y, -2e6 + 1.0, 1e-9);
        EXPECT_NEAR(plate.inertia, rectangle_inertia(3.0, 2.0), 1e-9);
        std::reverse(rings[0].begin(), rings[0].end());
    }
}

TEST(MassProperties, OfATriangleBySidesAlone) {
    const std::vector<Ring> rings{{{0.0, 0.0}, {4.0, 1.0}, {1.0, 3.0}}};
    const MassProperties plate = mass_properties(rings);
    const double sides = (16.0 + 1.0) + (9.0 + 4.0) + (1.0 + 9.0);
    EXPECT_NEAR(plate.area, 5.5, 1e-12);
    EXPECT_NEAR(plate.centroid.x, 5.0 / 3.0, 1e-12);
    EXPECT_NEAR(plate.inertia, plate.area * sides / 36.0, 1e-12);
}

TEST(MassProperties, OfAFrameWithAnIslandInItsHoleInAnyOrder) {
    std::vector<Ring> rings{rectangle({-1.0, -1.0}, {1.0, 1.0}),
                            rectangle({-3.0, -3.0}, {3.0, 3.0}),
                            rectangle({-2.0, -2.0}, {2.0, 2.0})};
    std::reverse(rings[1].begin(), rings[1].end());
    const double inertia =
        rectangle_inertia(6.0, 6.0) - rectangle_inertia(4.0, 4.0) + rectangle_inertia(2.0, 2.0);
    for (int order = 0; order < 3; ++order) {
        const MassProperties plate = mass_properties(rings);
        EXPECT_NEAR(plate.area, 36.0 - 16.0 + 4.0, 1e-12);
        EXPECT_NEAR(plate.inertia, inertia, 1e-10);
        EXPECT_NEAR(simulation::length(plate.centroid), 0.0, 1e-12);
        std::rotate(rings.begin(), rings.begin() + 1, rings.end());
    }
}

TEST(MassProperties, OfAnAngleAreThoseOfItsTwoRectangles) {
    const std::vector<Ring> rings{
        {{0.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {1.0, 1.0}, {1.0, 4.0}, {0.0, 4.0}}};
    const MassProperties plate = mass_properties(rings);
    const Vector2 foot{1.5, 0.5};
    const Vector2 post{0.5, 2.5};
    EXPECT_NEAR(plate.area, 6.0, 1e-12);
    EXPECT_NEAR(plate.centroid.x, (foot.x + post.x) / 2.0, 1e-12);
    EXPECT_NEAR(plate.centroid.y, (foot.y + post.y) / 2.0, 1e-12);
    const double apart = simulation::length(simulation::operator-(foot, post)) / 2.0;
    EXPECT_NEAR(plate.inertia, 2.0 * rectangle_inertia(3.0, 1.0) + 6.0 * apart * apart, 1e-10);
}

TEST(MassProperties, OfSeparatePartsAddUp) {
    const std::vector<Ring> rings{rectangle({-3.0, 0.0}, {-2.0, 1.0}),
                                  rectangle({2.0, 0.0}, {3.0, 1.0})};
    const MassProperties plate = mass_properties(rings);
    EXPECT_NEAR(plate.area, 2.0, 1e-12);
    EXPECT_NEAR(plate.inertia, 2.0 * rectangle_inertia(1.0, 1.0) + 2.0 * 2.5 * 2.5, 1e-10);
}

}  // namespace
}  // namespace nearfield::test
