#include <tests/limits/cut.hpp>
#include <tests/query/device_queries.hpp>
#include <tests/support/run_on_threads.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <thread>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 33000;

/// Rays and points that are submitted, and collected while the world has changed; and what is
/// refused.
class DeviceQuerySubmissions : public DeviceQueriesTest {
protected:
    std::vector<RayHit> hits_of_cpu() {
        std::vector<RayHit> hits(segments_.size());
        EXPECT_TRUE(world().cast_rays(segments_, hits).ok());
        return hits;
    }
    std::vector<NearestHit> nearest_of_cpu() {
        std::vector<NearestHit> hits(points_.size());
        EXPECT_TRUE(world().find_nearest({}, points_, hits).ok());
        return hits;
    }
    void ask(Random& random) {
        segments_ = segments_of_tiles(random, 200);
        points_ = points_of_tiles(random, 200);
        for (const Segment& segment : some_segments(random, 200, 6.0)) {
            segments_.push_back(segment);
            points_.push_back(segment.from);
        }
    }
    void expect_collected(DeviceRays& rays, const std::vector<RayHit>& expected) {
        std::vector<RayHit> found(expected.size());
        const Status status = rays.collect(found);
        ASSERT_TRUE(status.ok()) << status.text();
        expect_equal(found, expected);
        EXPECT_GT(rays.left_to_cpu(), 0U);
    }
    void expect_collected(DeviceNearest& nearest, const std::vector<NearestHit>& expected) {
        std::vector<NearestHit> found(expected.size());
        const Status status = nearest.collect(found);
        ASSERT_TRUE(status.ok()) << status.text();
        expect_equal(found, expected);
        EXPECT_GT(nearest.left_to_cpu(), 0U);
    }

    std::vector<Segment> segments_;
    std::vector<Vector2> points_;
};

/// Also where the CPU answers by itself.
TEST_F(DeviceQuerySubmissions, TellOfTheWorldAsItWas) {
    Random random(seed);
    std::vector<InstanceHandle> added = add_tiles();
    const ShapeHandle deforming = add_shape(star(random, 30, 0.5));
    added.push_back(add(deforming, {{3.0, 3.0}, 0.0}));
    DeviceRays rays;
    DeviceNearest nearest;
    for (int i = 0; i < 6; ++i) {
        SCOPED_TRACE(i);
        ask(random);
        const std::vector<RayHit> hits = hits_of_cpu();
        const std::vector<NearestHit> near = nearest_of_cpu();
        ASSERT_TRUE(world().submit(rays, segments_).ok());
        ASSERT_TRUE(world().submit(nearest, {}, points_).ok());
        EXPECT_EQ(rays.size(), segments_.size());
        // All that may change, some of it in each turn.
        if (i != 1) {
            ASSERT_TRUE(world().move(added[static_cast<std::size_t>(i)], {{0.1, 0.2}, 0.3}).ok());
            ASSERT_TRUE(world().set_filter(added[20], 1U << (i % 2), UINT32_MAX).ok());
        }
        if (i % 3 == 2) {
            ASSERT_TRUE(context().update_shape(deforming, star(random, 40, 0.4)).ok());
            ASSERT_TRUE(world().remove(added.back()).ok());
            added.back() = add(deforming, any_pose(random, 5.0));
        }
        segments_.front() = {};
        points_.front() = {};
        expect_collected(rays, hits);
        expect_collected(nearest, near);
        EXPECT_GT(rays.timings().total, 0.0);
    }
    ask(random);
    const std::vector<RayHit> hits = hits_of_cpu();
    ASSERT_TRUE(world().submit(rays, segments_).ok());
    remove(added);
    expect_collected(rays, hits);
}

TEST_F(DeviceQuerySubmissions, AreReadyInTime) {
    add_tiles();
    Random random(seed + 1000);
    ask(random);
    DeviceRays rays;
    EXPECT_FALSE(rays.is_ready());
    ASSERT_TRUE(world().submit(rays, segments_).ok());
    while (!rays.is_ready()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    DeviceRays moved = std::move(rays);
    expect_collected(moved, hits_of_cpu());
    EXPECT_FALSE(moved.is_ready());
    // What is not collected is waited for by the destructor.
    ASSERT_TRUE(world().submit(moved, segments_).ok());
}

/// What was uploaded of one is of no use for the other.
TEST_F(DeviceQuerySubmissions, OfTwoWorldsInTurns) {
    Random random(seed + 2000);
    add_tiles();
    ask(random);
    Expected<World> other = World::create(context());
    ASSERT_TRUE(other.has_value()) << other.error().text();
    const ShapeHandle shape = add_shape(star(random, 20, 0.5));
    for (int i = 0; i < 43; ++i) {
        ASSERT_TRUE(other->add({.shape = shape, .pose = any_pose(random, 6.0)}).has_value());
    }
    DeviceRays rays;
    std::vector<RayHit> found(segments_.size());
    std::vector<RayHit> expected(segments_.size());
    for (int i = 0; i < 3; ++i) {
        compare(rays, segments_);
        ASSERT_TRUE(other->cast_rays(rays, segments_, found).ok());
        ASSERT_TRUE(other->cast_rays(segments_, expected).ok());
        EXPECT_GT(expect_equal(found, expected), 100U);
    }
}

TEST_F(DeviceQuerySubmissions, DoNotDependOnJobs) {
    Settings settings = on_demand();
    settings.jobs = {nullptr, 3, run_on_threads};
    Expected<Context> context = Context::create(host_device(), settings);
    ASSERT_TRUE(context.has_value()) << context.error().text();
    Expected<World> world = World::create(*context);
    ASSERT_TRUE(world.has_value()) << world.error().text();
    Random random(seed + 3000);
    for (const Rings& rings : some_shapes(random)) {
        const ShapeHandle shape = *context->add_shape(rings);
        for (int i = 0; i < 4; ++i) {
            ASSERT_TRUE(world->add({.shape = shape, .pose = any_pose(random, 8.0)}).has_value());
        }
    }
    const std::vector<Segment> segments = some_segments(random, 5000, 12.0);
    const std::vector<Vector2> points = some_points(random, 5000, 12.0);
    DeviceRays rays;
    DeviceNearest nearest;
    std::vector<RayHit> hits(segments.size());
    std::vector<RayHit> expected(segments.size());
    ASSERT_TRUE(world->cast_rays(rays, segments, hits).ok());
    ASSERT_TRUE(world->cast_rays(segments, expected).ok());
    EXPECT_GT(expect_equal(hits, expected), 500U);
    std::vector<NearestHit> near(points.size());
    std::vector<NearestHit> nearest_expected(points.size());
    ASSERT_TRUE(world->find_nearest(nearest, {}, points, near).ok());
    ASSERT_TRUE(world->find_nearest({}, points, nearest_expected).ok());
    EXPECT_EQ(expect_equal(near, nearest_expected), points.size());
}

TEST_F(DeviceQuerySubmissions, AreRefusedByName) {
    add_tiles();
    Random random(seed + 4000);
    ask(random);
    std::vector<RayHit> hits(segments_.size());
    std::vector<NearestHit> near(points_.size());
    DeviceRays rays;
    DeviceNearest nearest;
    const auto expect = [](const Status& status, StatusCode code, const std::string& call) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_EQ(status.message().find(call + ": "), 0U) << status.text();
    };
    constexpr StatusCode invalid = StatusCode::invalid_query;
    expect(rays.collect(hits), StatusCode::not_ready, "collect");
    expect(nearest.collect(near), StatusCode::not_ready, "collect");
    const std::vector<Segment> far{{{0.0, 0.0}, {1e300, 0.0}}};
    expect(world().submit(rays, far), invalid, "cast_rays");
    expect(world().cast_rays(rays, segments_, {}), invalid, "cast_rays");
    expect(world().submit(nearest, {}, std::vector<Vector2>{{0.0, std::nan("")}}), invalid,
           "find_nearest");
    expect(world().submit(nearest, {.count = 2}, points_), invalid, "find_nearest");
    expect(world().submit(nearest, {.max_distance = -1.0}, points_), invalid, "find_nearest");
    expect(world().submit(nearest, {.kind = static_cast<NearestKind>(7)}, points_), invalid,
           "find_nearest");
    const WorldFilter of_another{.ignored = {.index = 0, .generation = 0, .world = 1U << 30}};
    expect(world().submit(rays, segments_, of_another), StatusCode::unknown_instance, "cast_rays");
    expect(world().submit(nearest, {.filter = of_another}, points_), StatusCode::unknown_instance,
           "find_nearest");
    ASSERT_TRUE(world().submit(rays, segments_).ok());
    expect(world().submit(rays, segments_), StatusCode::not_ready, "cast_rays");
    expect(rays.collect({}), invalid, "collect");  // and nothing is lost
    expect_collected(rays, hits_of_cpu());
    expect(rays.collect(hits), StatusCode::not_ready, "collect");
}

TEST_F(DeviceQuerySubmissions, AreRefusedWithoutMemoryOrCompute) {
    const auto cast = [](Context& context) {
        const ShapeHandle shape = *context.add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        World world = *World::create(context);
        EXPECT_TRUE(world.add({.shape = shape}).has_value());
        DeviceRays rays;
        const std::vector<Segment> segments(20000, Segment{{-1.0, 0.5}, {2.0, 0.5}});
        std::vector<RayHit> hits(segments.size());
        Status status = world.cast_rays(rays, segments, hits);
        // After a refusal everything works that is not refused.
        const Status fewer =
            world.cast_rays(rays, std::span(segments).first(10), std::span(hits).first(10));
        EXPECT_EQ(fewer.ok(), status.code() != StatusCode::unsupported_technique);
        return status;
    };
    Settings settings = on_demand();
    settings.memory_limit = 1U << 20U;
    Expected<Context> small = Context::create(host_device(), settings);
    ASSERT_TRUE(small.has_value()) << small.error().text();
    EXPECT_EQ(cast(*small).code(), StatusCode::too_large);
    settings = on_demand();
    settings.techniques.compute = false;
    Expected<Context> drawing_only = Context::create(host_device(), settings);
    ASSERT_TRUE(drawing_only.has_value()) << drawing_only.error().text();
    EXPECT_EQ(cast(*drawing_only).code(), StatusCode::unsupported_technique);
    Expected<Context> without_device = Context::create_cpu();
    ASSERT_TRUE(without_device.has_value()) << without_device.error().text();
    EXPECT_EQ(cast(*without_device).code(), StatusCode::unsupported_technique);
}

/// A call that limits end fails as a whole, and the next one answers as if nothing had been.
TEST_F(DeviceQuerySubmissions, EndAtTheirLimits) {
    add_tiles();
    Random random(seed + 5000);
    ask(random);
    DeviceRays rays;
    DeviceNearest nearest;
    std::vector<RayHit> hits(segments_.size());
    std::vector<NearestHit> near(points_.size());
    const std::uint64_t cuts_of_rays = cut_everywhere(dense, [&](std::uint64_t at) {
        const Cut cut(at);
        const Status status = world().cast_rays(rays, segments_, hits, {}, cut.limits());
        EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok);
        if (cut.has_cut()) {
            EXPECT_EQ(rays.size(), 0U);
            EXPECT_FALSE(rays.is_ready());
        }
        return cut.has_cut();
    });
    EXPECT_GT(cuts_of_rays, 3U);
    compare(rays, segments_);
    const std::uint64_t cuts_of_points = cut_everywhere(dense, [&](std::uint64_t at) {
        const Cut cut(at);
        const Status status = world().find_nearest(nearest, {}, points_, near, cut.limits());
        EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok);
        return cut.has_cut();
    });
    EXPECT_GT(cuts_of_points, 3U);
    compare(nearest, {}, points_);
}

}  // namespace
}  // namespace nearfield::test
