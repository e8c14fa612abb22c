#include "scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

namespace nearfield::test {
namespace {

/// What the examples of the headers name: a world of a square on the left and a robot on the right,
/// without a device, so that what asks for one is refused.
class WorldExamples : public testing::Test {
protected:
    WorldExamples()
        : box(*context.add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}))),
          robot(*context.add_shape(rectangle({0.0, 0.0}, {0.5, 0.5}))) {
        EXPECT_TRUE(world.add({.shape = box}).has_value());
        handle_of_robot = *world.add({.shape = robot, .pose = {{9.0, 0.0}, 0.0}});
    }

    static void step_the_rest() {}
    void use(const RayHit& hit) { places.push_back(hit.point); }
    void draw(InstanceHandle instance) { drawn.push_back(instance); }

    // NOLINTBEGIN(readability-identifier-naming): as a caller writes them.
    Context context;
    World world{context};
    ShapeHandle box;
    ShapeHandle robot;
    InstanceHandle handle_of_robot;
    Pose start;
    Pose next{{1.0, 0.0}, 0.0};
    std::vector<Segment> segments{{{-1.0, 0.5}, {2.0, 0.5}}};
    std::vector<Vector2> points{{-1.0, 0.5}};
    std::vector<Pose> poses{{{0.5, 0.5}, 0.0}, {{9.0, 0.0}, 0.0}};
    std::vector<Sweep> sweeps{{{{-3.0, 0.0}, 0.0}, {{3.0, 0.0}, 0.0}}};
    Rectangle window{{-5.0, -5.0}, {5.0, 5.0}};
    Vector2 cursor{9.1, 0.1};
    std::vector<RayHit> hits = std::vector<RayHit>(1);
    std::vector<NearestHit> nearest = std::vector<NearestHit>(1);
    std::vector<std::uint8_t> blocked = std::vector<std::uint8_t>(2);
    WorldRequest request;
    std::vector<Vector2> places;
    std::vector<InstanceHandle> drawn;
    // NOLINTEND(readability-identifier-naming)
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
TEST_F(WorldExamples, CompileAndRun) {
#include <examples/world.hpp>
#include <examples/world_request.hpp>
    ASSERT_EQ(places.size(), 2U);
    EXPECT_EQ(places.back(), (Vector2{1.0, 0.5}));
    EXPECT_EQ(drawn.size(), 1U);
    EXPECT_EQ(nearest.front().distance, 1.0);
    EXPECT_EQ(blocked, (std::vector<std::uint8_t>{1, 1}));
}
#pragma GCC diagnostic pop

/// What the examples of the queries name: an arrow in a U-shaped channel, or far to its left.
class QueryExamples : public testing::Test {
protected:
    void push(Vector2 /*position*/, Vector2 /*direction*/, double depth) {
        deepest = std::max(deepest, depth);
    }
    void solve(Vector2 /*normal*/, const ContactPoint& /*extreme*/) { ++solved; }

    // NOLINTBEGIN(readability-identifier-naming): as a caller writes them.
    Context context;
    AddedShape arrow =
        context.add_shape(Rings{{{0, -1}, {4, -1}, {4, -2}, {7, 0}, {4, 2}, {4, 1}, {0, 1}}});
    AddedShape channel = context.add_shape(
        Rings{{{0, -5}, {10, -5}, {10, 5}, {0, 5}, {0, 3}, {8, 3}, {8, -3}, {0, -3}}});
    AddedShape sheet = context.add_shape(rectangle({-20.0, -20.0}, {20.0, 20.0}));
    Pose pose{{1.5, 0.5}, 0.0};
    Pose far_pose{{-9.0, 0.0}, 0.0};
    double deepest = 0.0;
    int solved = 0;
    // NOLINTEND(readability-identifier-naming)
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
TEST_F(QueryExamples, CompileAndRun) {
#include <examples/query.hpp>
    EXPECT_EQ(deepest, 0.5);
    EXPECT_GT(solved, 0);
}
#pragma GCC diagnostic pop

}  // namespace
}  // namespace nearfield::test
