#include <tests/query/device_queries.hpp>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 32000;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The nearest instances, and edges, of points that the device finds.
class DeviceNearestOfWorld : public DeviceQueriesTest {
protected:
    /// Both kinds, within several distances.
    void compare_all(DeviceNearest& nearest, const std::vector<Vector2>& points) {
        for (const NearestKind kind : {NearestKind::instances, NearestKind::edges}) {
            for (const double reach : {infinity, 0.7, 0.05, 0.0}) {
                SCOPED_TRACE(reach);
                compare(nearest, {.kind = kind, .max_distance = reach}, points);
            }
        }
    }
};

TEST_F(DeviceNearestOfWorld, AreThoseOfTheCpu) {
    DeviceNearest nearest;
    for_each_case(seed, 6, [&](Random& random) {
        const std::vector<InstanceHandle> added = add_some(random, 8.0);
        const std::vector<Vector2> points = some_points(random, 1000, 12.0);
        compare_all(nearest, points);
        EXPECT_EQ(compare(nearest, {}, points), points.size());
        EXPECT_LT(nearest.left_to_cpu(), 100U);
        remove(added);
    });
}

TEST_F(DeviceNearestOfWorld, DoNotShowTheirHistory) {
    DeviceNearest nearest;
    for_each_case(seed + 1000, 2, [&](Random& random) {
        run_history(random, {.steps = 12, .instances = 150, .extent = 25.0},
                    [&] { EXPECT_EQ(compare(nearest, {}, some_points(random, 300, 25.0)), 300U); });
    });
}

/// More instances than three levels of boxes hold, sizes from 1/1000 to 10, and one below them all,
/// in which all points are.
TEST_F(DeviceNearestOfWorld, AmongManyInstancesOfAllSizes) {
    Random random(seed + 2000);
    DeviceNearest nearest;
    std::vector<ShapeHandle> shapes;
    for (const double size : {0.001, 0.01, 0.1, 1.0}) {
        shapes.push_back(add_shape(scaled_and_moved(star(random, 12, 0.5), size, {0.0, 0.0})));
    }
    for (int i = 0; i < 700; ++i) {
        add(shapes[static_cast<std::size_t>(i % 4)], any_pose(random, 10.0));
    }
    const std::vector<Vector2> points = some_points(random, 1000, 12.0);
    compare_all(nearest, points);
    add(add_shape(rectangle({-100.0, -100.0}, {100.0, 100.0})), {});
    compare_all(nearest, points);
    EXPECT_LT(nearest.left_to_cpu(), 50U);
}

TEST_F(DeviceNearestOfWorld, FarFromTheOrigin) {
    DeviceNearest nearest;
    for_each_case(seed + 3000, 3, [&](Random& random) {
        const Vector2 far{1e6, -3e6};
        const std::vector<InstanceHandle> added = add_some(random, 8.0, far);
        compare_all(nearest, some_points(random, 500, 12.0, far));
        compare_all(nearest, some_points(random, 100, 12.0));  // millions away
        remove(added);
    });
}

/// On boundaries, at vertices, and as near to several.
TEST_F(DeviceNearestOfWorld, AmongTilesThatTouch) {
    DeviceNearest nearest;
    for (const Vector2& at : {Vector2{0.0, 0.0}, Vector2{1e6, 2e6}, Vector2{0.1, 0.7}}) {
        Random random(seed + 4000);
        const std::vector<InstanceHandle> added = add_tiles(at);
        compare_all(nearest, points_of_tiles(random, 500, at));
        EXPECT_GT(nearest.left_to_cpu(), 0U);
        compare_all(nearest, some_points(random, 500, 6.0, at));
        remove(added);
    }
}

/// On the middle line of a rectangle two edges are as near but for rounding, of which the CPU's
/// search names one.
TEST_F(DeviceNearestOfWorld, InTheMiddleOfInstances) {
    DeviceNearest nearest;
    Random random(seed + 9000);
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
    EXPECT_EQ(compare(nearest, {}, points), points.size());
    EXPECT_EQ(nearest.left_to_cpu(), points.size());
    EXPECT_EQ(compare(nearest, {.kind = NearestKind::edges}, points), points.size());
    EXPECT_EQ(nearest.left_to_cpu(), 0U);
}

TEST_F(DeviceNearestOfWorld, ConsiderFilters) {
    DeviceNearest nearest;
    Random random(seed + 5000);
    consider_filters(random, [&](ShapeHandle, const WorldFilter& filter) {
        compare(nearest, {.filter = filter}, some_points(random, 200, 8.0));
        compare(nearest, {.kind = NearestKind::edges, .filter = filter},
                some_points(random, 200, 8.0));
    });
}

TEST_F(DeviceNearestOfWorld, OfSmallWorlds) {
    DeviceNearest nearest;
    Random random(seed + 6000);
    EXPECT_EQ(compare(nearest, {}, some_points(random, 10, 2.0)), 0U);
    EXPECT_EQ(compare(nearest, {}, {}), 0U);
    const InstanceHandle only = add(add_shape(star(random, 5, 0.5)), {});
    EXPECT_EQ(compare(nearest, {}, some_points(random, 200, 2.0)), 200U);
    ASSERT_TRUE(world().remove(only).ok());
    EXPECT_EQ(compare(nearest, {}, some_points(random, 10, 2.0)), 0U);
}

/// The deepest is too deep to count, so that another one does, or none.
TEST_F(DeviceNearestOfWorld, CountUpToTheLargestDistanceAlsoInside) {
    DeviceNearest nearest;
    add(add_shape(rectangle({-4.0, -4.0}, {4.0, 4.0})), {});
    add(add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0})), {});
    add(add_shape(rectangle({0.0, -2.0}, {0.5, 2.0})), {});
    const std::vector<Vector2> points{
        {0.0, 0.0}, {0.25, 0.25}, {-0.5, 0.0}, {3.0, 3.0}, {7.0, 0.0}};
    for (const double reach : {5.0, 4.0, 3.75, 3.5, 3.0, 1.0, 0.75, 0.5, 0.25, 0.1}) {
        SCOPED_TRACE(reach);
        compare(nearest, {.max_distance = reach}, points);
        // As near to it as single precision cannot tell.
        compare(nearest, {.max_distance = reach * (1.0 - 1e-10)}, points);
        compare(nearest, {.max_distance = reach * (1.0 + 1e-10)}, points);
    }
}

/// Shapes that are too small for single precision, and points that are too far away for it.
TEST_F(DeviceNearestOfWorld, LeaveToTheCpuWhatTheyCannotTell) {
    DeviceNearest nearest;
    Random random(seed + 7000);
    const ShapeHandle tiny = add_shape(scaled_and_moved(star(random, 9, 0.5), 1e-11, {}));
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 20; ++i) {
        add(tiny, any_pose(random, 1e-10));
        add(square, {{10.0, 0.0}, 0.0});  // all at the same place
    }
    compare(nearest, {}, some_points(random, 100, 1e-10));
    EXPECT_EQ(nearest.left_to_cpu(), 100U);
    compare(nearest, {}, {{9.0, 0.5}, {10.5, 0.25}});
    EXPECT_EQ(nearest.left_to_cpu(), 2U);
}

/// Against the edges of all instances, one after the other, in extended precision.
TEST_F(DeviceNearestOfWorld, AreAsNearAsTheySay) {
    using Wide = long double;
    Random random(seed + 8000);
    DeviceNearest nearest;
    const Rings rings = star(random, 20, 0.5);
    const ShapeHandle shape = add_shape(rings);
    std::vector<Pose> poses;
    for (int i = 0; i < 60; ++i) {
        poses.push_back(any_pose(random, 8.0));
        add(shape, poses.back());
    }
    const std::vector<Vector2> points = some_points(random, 500, 9.0);
    std::vector<NearestHit> hits(points.size());
    ASSERT_TRUE(world().find_nearest(nearest, {}, points, hits).ok());
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

}  // namespace
}  // namespace nearfield::test
