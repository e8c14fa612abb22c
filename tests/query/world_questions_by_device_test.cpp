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

/// Against the edges of all instances, one after the other, in extended precision.
TEST_F(RaysByDevice, HitWhatIsFirst) {
    using Wide = long double;
    struct WideVector {
        Wide x, y;
    };
    const auto cross = [](const WideVector& a, const WideVector& b) {
        return a.x * b.y - a.y * b.x;
    };
    Random random(39000);
    const Rings rings = star(random, 20, 0.5);
    const ShapeHandle shape = add_shape(rings);
    std::vector<Pose> poses;
    std::vector<InstanceHandle> handles;
    for (int i = 0; i < 60; ++i) {
        poses.push_back(any_pose(random, 8.0));
        handles.push_back(add(shape, poses.back()));
    }
    const std::vector<Segment> segments = some_segments(random, 500, 9.0);
    std::vector<RayHit> hits(segments.size());
    ASSERT_TRUE(world().cast_rays(segments, hits, by_device).ok());
    for (std::size_t k = 0; k < segments.size(); ++k) {
        const Segment& segment = segments[k];
        const WideVector way{static_cast<Wide>(segment.to.x) - segment.from.x,
                             static_cast<Wide>(segment.to.y) - segment.from.y};
        Wide first = 2.0L;
        for (const Pose& pose : poses) {
            const Wide cosine = std::cos(static_cast<Wide>(pose.angle));
            const Wide sine = std::sin(static_cast<Wide>(pose.angle));
            const auto placed = [&](const Vector2& v) {
                return WideVector{cosine * v.x - sine * v.y + pose.translation.x - segment.from.x,
                                  sine * v.x + cosine * v.y + pose.translation.y - segment.from.y};
            };
            for (std::size_t i = 0; i < rings[0].size(); ++i) {
                const WideVector a = placed(rings[0][i]);
                const WideVector b = placed(rings[0][(i + 1) % rings[0].size()]);
                const WideVector along{b.x - a.x, b.y - a.y};
                const Wide t = cross(a, along) / cross(way, along);
                const Wide s = cross(a, way) / cross(way, along);
                first =
                    t >= 0.0L && t <= 1.0L && s >= 0.0L && s <= 1.0L ? std::min(first, t) : first;
            }
        }
        if (first <= 1.0L) {
            const Wide length = std::hypot(way.x, way.y);
            EXPECT_NEAR(static_cast<double>(hits[k].parameter * length),
                        static_cast<double>(first * length), 1e-9);
        } else {
            EXPECT_EQ(hits[k].instance, InstanceHandle{});
        }
    }
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

/// Against the edges of all instances, one after the other, in extended precision.
TEST_F(PointsByDevice, AreAsNearAsTheySay) {
    using Wide = long double;
    Random random(40000);
    const Rings rings = star(random, 20, 0.5);
    const ShapeHandle shape = add_shape(rings);
    std::vector<Pose> poses;
    for (int i = 0; i < 60; ++i) {
        poses.push_back(any_pose(random, 8.0));
        add(shape, poses.back());
    }
    const std::vector<Vector2> points = some_points(random, 500, 9.0);
    std::vector<NearestHit> hits(points.size());
    ASSERT_TRUE(world().find_nearest({}, points, hits, by_device).ok());
    for (std::size_t k = 0; k < points.size(); ++k) {
        Wide least = infinity;
        for (const Pose& pose : poses) {
            const Wide cosine = std::cos(static_cast<Wide>(pose.angle));
            const Wide sine = std::sin(static_cast<Wide>(pose.angle));
            // The point in coordinates of the shape.
            const Wide dx = static_cast<Wide>(points[k].x) - pose.translation.x;
            const Wide dy = static_cast<Wide>(points[k].y) - pose.translation.y;
            const Wide x = cosine * dx + sine * dy;
            const Wide y = cosine * dy - sine * dx;
            Wide apart = infinity;
            bool is_inside = false;
            for (std::size_t i = 0; i < rings[0].size(); ++i) {
                const Vector2& a = rings[0][i];
                const Vector2& b = rings[0][(i + 1) % rings[0].size()];
                const Wide ex = static_cast<Wide>(b.x) - a.x;
                const Wide ey = static_cast<Wide>(b.y) - a.y;
                const Wide t =
                    std::clamp(((x - a.x) * ex + (y - a.y) * ey) / (ex * ex + ey * ey), 0.0L, 1.0L);
                apart = std::min(apart, std::hypot(a.x + t * ex - x, a.y + t * ey - y));
                if ((a.y > y) != (b.y > y)) {
                    is_inside = is_inside != (x < a.x + (y - a.y) / ey * ex);
                }
            }
            least = std::min(least, is_inside ? -apart : apart);
        }
        EXPECT_NEAR(hits[k].distance, static_cast<double>(least), hits[k].error_bound);
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

TEST_F(PosesByDevice, OfAShapeThatDeforms) {
    for_each_case(36000, 2, [&](Random& random) {
        const ShapeHandle shape = add_shape(star(random, 15, 0.4));
        run_history(random, {.steps = 10, .instances = 150, .extent = 60.0}, [&] {
            compare(QuestionKind::poses, {.poses = some_poses(random, 200, 60.0), .shape = shape});
            ASSERT_TRUE(context().update_shape(shape, star(random, 16, 0.4)).ok());
            compare(QuestionKind::poses, {.poses = some_poses(random, 50, 60.0), .shape = shape});
        });
    });
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
