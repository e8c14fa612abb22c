#include <tests/query/device_queries.hpp>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 31000;

/// The first hits of segments that the device finds.
class DeviceRaysOfWorld : public DeviceQueriesTest {};

TEST_F(DeviceRaysOfWorld, AreThoseOfTheCpu) {
    DeviceRays rays;
    for_each_case(seed, 6, [&](Random& random) {
        const std::vector<InstanceHandle> added = add_some(random, 8.0);
        EXPECT_GT(compare(rays, some_segments(random, 2000, 12.0)), 200U);
        EXPECT_LT(rays.left_to_cpu(), 100U);
        remove(added);
    });
}

TEST_F(DeviceRaysOfWorld, DoNotShowTheirHistory) {
    DeviceRays rays;
    for_each_case(seed + 1000, 2, [&](Random& random) {
        run_history(random, {.steps = 12, .instances = 150, .extent = 25.0},
                    [&] { EXPECT_GT(compare(rays, some_segments(random, 300, 25.0)), 30U); });
    });
}

/// More instances than three levels of boxes hold, sizes from 1/1000 to 10, and one below them all.
TEST_F(DeviceRaysOfWorld, AmongManyInstancesOfAllSizes) {
    Random random(seed + 2000);
    DeviceRays rays;
    std::vector<ShapeHandle> shapes;
    for (const double size : {0.001, 0.01, 0.1, 1.0}) {
        shapes.push_back(add_shape(scaled_and_moved(star(random, 12, 0.5), size, {0.0, 0.0})));
    }
    add(add_shape(rectangle({-100.0, -100.0}, {100.0, 100.0})), {});
    for (int i = 0; i < 700; ++i) {
        add(shapes[static_cast<std::size_t>(i % 4)], any_pose(random, 10.0));
    }
    EXPECT_GT(compare(rays, some_segments(random, 3000, 12.0)), 1000U);
    EXPECT_LT(rays.left_to_cpu(), 100U);
}

TEST_F(DeviceRaysOfWorld, FarFromTheOrigin) {
    DeviceRays rays;
    for_each_case(seed + 3000, 3, [&](Random& random) {
        const Vector2 far{1e6, -3e6};
        const std::vector<InstanceHandle> added = add_some(random, 8.0, far);
        EXPECT_GT(compare(rays, some_segments(random, 1000, 12.0, far)), 50U);
        EXPECT_LT(rays.left_to_cpu(), 100U);
        // So long that single precision cannot tell.
        std::vector<Segment> long_ones = some_segments(random, 100, 12.0, far);
        for (Segment& segment : long_ones) {
            segment.from.x -= 4e6;
        }
        compare(rays, long_ones);
        remove(added);
    });
}

/// Along shared edges, through vertices, from and to them, and without any length.
TEST_F(DeviceRaysOfWorld, AmongTilesThatTouch) {
    DeviceRays rays;
    for (const Vector2& at : {Vector2{0.0, 0.0}, Vector2{1e6, 2e6}, Vector2{0.1, 0.7}}) {
        Random random(seed + 4000);
        const std::vector<InstanceHandle> added = add_tiles(at);
        EXPECT_GT(compare(rays, segments_of_tiles(random, 2000, at)), 1000U);
        EXPECT_GT(rays.left_to_cpu(), 0U);
        compare(rays, some_segments(random, 500, 6.0, at));
        remove(added);
    }
}

/// So near vertices that single precision cannot tell what is hit, of what is in front or behind.
TEST_F(DeviceRaysOfWorld, PastVertices) {
    DeviceRays rays;
    for_each_case(seed + 9000, 8, [&](Random& random) {
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
        EXPECT_GT(compare(rays, segments), 400U);
        EXPECT_LT(rays.left_to_cpu(), 20U);
        remove(added);
    });
}

TEST_F(DeviceRaysOfWorld, ConsiderFilters) {
    DeviceRays rays;
    Random random(seed + 5000);
    const auto added = consider_filters(random, [&](ShapeHandle, const WorldFilter& filter) {
        compare(rays, some_segments(random, 200, 8.0), filter);
        // Two of them may be left to the CPU, which has to ignore the same instance.
        compare(rays, segments_of_tiles(random, 50), filter);
    });
    ASSERT_TRUE(world().remove(added[3]).ok());
    compare(rays, some_segments(random, 200, 8.0), {.ignored = added[3]});
}

/// A hierarchy of one box, and of none.
TEST_F(DeviceRaysOfWorld, OfSmallWorlds) {
    DeviceRays rays;
    Random random(seed + 6000);
    EXPECT_EQ(compare(rays, some_segments(random, 10, 2.0)), 0U);
    EXPECT_EQ(compare(rays, {}), 0U);
    const InstanceHandle only = add(add_shape(star(random, 5, 0.5)), {});
    EXPECT_GT(compare(rays, some_segments(random, 200, 2.0)), 5U);
    EXPECT_EQ(compare(rays, {}), 0U);
    ASSERT_TRUE(world().remove(only).ok());
    EXPECT_EQ(compare(rays, some_segments(random, 10, 2.0)), 0U);
}

/// Shapes that are too small or too large for single precision, and many edges at one vertex.
TEST_F(DeviceRaysOfWorld, LeaveToTheCpuWhatTheyCannotTell) {
    DeviceRays rays;
    Random random(seed + 7000);
    const ShapeHandle tiny = add_shape(scaled_and_moved(star(random, 9, 0.5), 1e-11, {}));
    const ShapeHandle fan = add_shape({{{0.0, 0.0}, {1.0, 0.1}, {1.0, 0.2}},
                                       {{0.0, 0.0}, {1.0, 0.3}, {1.0, 0.4}},
                                       {{0.0, 0.0}, {1.0, 0.5}, {1.0, 0.6}}});
    for (int i = 0; i < 20; ++i) {
        add(tiny, any_pose(random, 1e-10));
        add(fan, {{1.0, 0.0}, 0.0});
    }
    EXPECT_GT(compare(rays, some_segments(random, 200, 1e-10)), 20U);
    EXPECT_GT(rays.left_to_cpu(), 20U);
    EXPECT_EQ(compare(rays, {{{0.5, 0.0}, {1.5, 0.0}}, {{1.0, 5.0}, {1.0, -5.0}}}), 2U);
    EXPECT_EQ(rays.left_to_cpu(), 2U);
}

/// Against the edges of all instances, one after the other, in extended precision.
TEST_F(DeviceRaysOfWorld, HitWhatIsFirst) {
    using Wide = long double;
    struct WideVector {
        Wide x, y;
    };
    const auto cross = [](const WideVector& a, const WideVector& b) {
        return a.x * b.y - a.y * b.x;
    };
    Random random(seed + 8000);
    DeviceRays rays;
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
    ASSERT_TRUE(world().cast_rays(rays, segments, hits).ok());
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

}  // namespace
}  // namespace nearfield::test
