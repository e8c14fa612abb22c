#include <tests/query/world_questions.hpp>

/// \file What is particular to rays, points or poses that the device is asked about.

namespace nearfield::test {
namespace {

class RaysByDevice : public WorldQuestionsTest {};

/// So near vertices that single precision cannot tell what is hit, of what is in front or behind.
TEST_F(RaysByDevice, PastVertices) {
    for_each_case(40000, 8, [&](Random& random) {
        const Rings rings = star(random, 12, 0.5);
        const ShapeHandle shape = add_shape(rings);
        std::vector<InstanceHandle> added;
        std::vector<Segment> segments;
        for (int i = 0; i < 40; ++i) {
            const Pose pose = any_pose(random, 6.0);
            added.push_back(add(shape, pose));
            const double cosine = std::cos(pose.angle);
            const double sine = std::sin(pose.angle);
            for (const Vector2& v : rings[0]) {
                const Vector2 vertex{pose.translation.x + cosine * v.x - sine * v.y,
                                     pose.translation.y + sine * v.x + cosine * v.y};
                const Vector2 from = any_place(random, 8.0);
                const Vector2 beside = any_place(random, random.scale(1e-10, 1e-6), vertex);
                segments.push_back({from, {2.0 * beside.x - from.x, 2.0 * beside.y - from.y}});
            }
        }
        EXPECT_GT(compare(QuestionKind::rays, {.segments = segments}), 400U);
        EXPECT_LT(request_.left_to_cpu(), 20U);
        remove(added);
    });
}

/// Many edges at one vertex.
TEST_F(RaysByDevice, LeaveToTheCpuWhatTheyCannotTell) {
    const ShapeHandle fan = add_shape({{{0.0, 0.0}, {1.0, 0.1}, {1.0, 0.2}},
                                       {{0.0, 0.0}, {1.0, 0.3}, {1.0, 0.4}},
                                       {{0.0, 0.0}, {1.0, 0.5}, {1.0, 0.6}}});
    for (int i = 0; i < 20; ++i) {
        add(fan, {{1.0, 0.0}, 0.0});
    }
    EXPECT_EQ(compare(QuestionKind::rays,
                      {.segments = {{{0.5, 0.0}, {1.5, 0.0}}, {{1.0, 5.0}, {1.0, -5.0}}}}),
              2U);
    EXPECT_EQ(request_.left_to_cpu(), 2U);
}

class PointsByDevice : public WorldQuestionsTest {};

/// On the middle line of a rectangle two edges are as near but for rounding, of which the CPU's
/// search names one.
TEST_F(PointsByDevice, InTheMiddleOfInstances) {
    Random random(41000);
    const ShapeHandle shape = add_shape(rectangle({-2.0, -0.3}, {2.0, 0.3}));
    std::vector<Vector2> points;
    for (int i = 0; i < 30; ++i) {
        const Pose pose{{10.0 * i, 0.1 * i}, random.between(-4.0, 4.0)};
        add(shape, pose);
        for (int k = 0; k < 20; ++k) {
            const double along = random.between(-1.5, 1.5);
            points.push_back({pose.translation.x + std::cos(pose.angle) * along,
                              pose.translation.y + std::sin(pose.angle) * along});
        }
    }
    EXPECT_EQ(compare(QuestionKind::points, {.points = points}), points.size());
    EXPECT_EQ(request_.left_to_cpu(), points.size());
    EXPECT_EQ(
        compare(QuestionKind::points, {.points = points, .query = {.kind = NearestKind::edges}}),
        points.size());
    EXPECT_EQ(request_.left_to_cpu(), 0U);
}

/// The deepest is too deep to count, so that another one does, or none.
TEST_F(PointsByDevice, CountUpToTheLargestDistanceAlsoInside) {
    add(add_shape(rectangle({-4.0, -4.0}, {4.0, 4.0})), {});
    add(add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0})), {});
    add(add_shape(rectangle({0.0, -2.0}, {0.5, 2.0})), {});
    const std::vector<Vector2> points{
        {0.0, 0.0}, {0.25, 0.25}, {-0.5, 0.0}, {3.0, 3.0}, {7.0, 0.0}};
    for (const double reach : {5.0, 4.0, 3.75, 3.5, 3.0, 1.0, 0.75, 0.5, 0.25, 0.1}) {
        SCOPED_TRACE(reach);
        compare(QuestionKind::points, {.points = points, .query = {.max_distance = reach}});
        // As near to it as single precision cannot tell.
        compare(QuestionKind::points,
                {.points = points, .query = {.max_distance = reach * (1.0 - 1e-10)}});
        compare(QuestionKind::points,
                {.points = points, .query = {.max_distance = reach * (1.0 + 1e-10)}});
    }
}

/// Several instances at the same place.
TEST_F(PointsByDevice, LeaveToTheCpuWhatTheyCannotTell) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 20; ++i) {
        add(square, {{10.0, 0.0}, 0.0});
    }
    compare(QuestionKind::points, {.points = {{9.0, 0.5}, {10.5, 0.25}}});
    EXPECT_EQ(request_.left_to_cpu(), 2U);
}

class PosesByDevice : public WorldQuestionsTest {};

TEST_F(PosesByDevice, OfShapesOfAllKinds) {
    for_each_case(34000, 4, [&](Random& random) {
        const std::vector<InstanceHandle> added = add_some(random, 15.0);
        std::size_t met = 0;
        std::size_t left = 0;
        for (const Rings& rings : some_shapes(random)) {
            met += compare(QuestionKind::poses,
                           {.poses = some_poses(random, 200, 20.0), .shape = add_shape(rings)});
            left += request_.left_to_cpu();
        }
        EXPECT_GT(met, 300U);
        EXPECT_LT(left, 150U);
        remove(added);
    });
}

/// Rings in holes, islands in lakes, and shapes around others, whose boundaries do not meet.
TEST_F(PosesByDevice, WithinEachOther) {
    Random random(35000);
    Rings lake = rectangle({-2.0, -2.0}, {2.0, 2.0});
    lake.push_back({{-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}});
    const ShapeHandle small = add_shape(star(random, 9, 0.05));
    const ShapeHandle large = add_shape(rectangle({-9.0, -9.0}, {9.0, 9.0}));
    add(add_shape(lake), {{1.0, 1.0}, 0.4});
    add(small, {{8.0, 8.0}, 0.0});
    for (const ShapeHandle shape : {small, large, add_shape(lake)}) {
        compare(QuestionKind::poses, {.poses = some_poses(random, 500, 6.0), .shape = shape});
        EXPECT_LT(request_.left_to_cpu(), 10U);
    }
}

TEST_F(PosesByDevice, OfAllSizesFarFromTheOrigin) {
    for_each_case(37000, 2, [&](Random& random) {
        const Vector2 far{1e6, -3e6};
        const std::vector<InstanceHandle> added = add_some(random, 15.0, far);
        for (const double size : {0.001, 0.1, 10.0, 1000.0}) {
            const ShapeHandle shape = add_shape(scaled_and_moved(star(random, 12, 0.5), size, {}));
            compare(QuestionKind::poses,
                    {.poses = some_poses(random, 200, 20.0, far), .shape = shape});
        }
        remove(added);
    });
}

}  // namespace
}  // namespace nearfield::test
