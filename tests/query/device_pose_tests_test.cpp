#include <tests/query/device_queries.hpp>

#include <cstdint>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 34000;

/// Poses of a shape that the device tests against a world.
class DevicePoseTestsOfWorld : public DeviceQueriesTest {
protected:
    /// Returns at how many of them the shape meets an instance.
    std::size_t compare_poses(DevicePoseTests& tests, const PoseTestQuery& query,
                              const std::vector<Pose>& poses) {
        std::vector<std::uint8_t> found(poses.size(), 7);
        std::vector<std::uint8_t> expected(poses.size());
        const Status status = world().test_poses(tests, query, poses, found);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_TRUE(world().test_poses(query, poses, expected).ok());
        EXPECT_EQ(found, expected);
        return static_cast<std::size_t>(std::count(expected.begin(), expected.end(), 1));
    }
    static std::vector<Pose> some_poses(Random& random, int count, double extent,
                                        const Vector2& around = {}) {
        std::vector<Pose> poses;
        for (int i = 0; i < count; ++i) {
            poses.push_back({any_place(random, extent, around), random.between(-4.0, 4.0)});
        }
        return poses;
    }
};

TEST_F(DevicePoseTestsOfWorld, AreThoseOfTheCpu) {
    DevicePoseTests tests;
    for_each_case(seed, 4, [&](Random& random) {
        const std::vector<InstanceHandle> added = add_some(random, 15.0);
        std::size_t met = 0;
        std::size_t left = 0;
        for (const Rings& rings : some_shapes(random)) {
            met += compare_poses(tests, {.shape = add_shape(rings)}, some_poses(random, 200, 20.0));
            left += tests.left_to_cpu();
        }
        EXPECT_GT(met, 300U);
        EXPECT_LT(left, 150U);
        remove(added);
    });
}

/// Rings in holes, islands in lakes, and shapes around others, whose boundaries do not meet.
TEST_F(DevicePoseTestsOfWorld, WithinEachOther) {
    DevicePoseTests tests;
    Random random(seed + 1000);
    Rings lake = rectangle({-2.0, -2.0}, {2.0, 2.0});
    lake.push_back({{-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}});
    const ShapeHandle small = add_shape(star(random, 9, 0.05));
    const ShapeHandle large = add_shape(rectangle({-9.0, -9.0}, {9.0, 9.0}));
    add(add_shape(lake), {{1.0, 1.0}, 0.4});
    add(small, {{8.0, 8.0}, 0.0});
    for (const ShapeHandle shape : {small, large, add_shape(lake)}) {
        compare_poses(tests, {.shape = shape}, some_poses(random, 500, 6.0));
        EXPECT_LT(tests.left_to_cpu(), 10U);
    }
}

TEST_F(DevicePoseTestsOfWorld, DoNotShowTheirHistory) {
    DevicePoseTests tests;
    for_each_case(seed + 2000, 2, [&](Random& random) {
        const ShapeHandle shape = add_shape(star(random, 15, 0.4));
        run_history(random, {.steps = 10, .instances = 150, .extent = 60.0}, [&] {
            compare_poses(tests, {.shape = shape}, some_poses(random, 200, 60.0));
            ASSERT_TRUE(context().update_shape(shape, star(random, 16, 0.4)).ok());
            compare_poses(tests, {.shape = shape}, some_poses(random, 50, 60.0));
        });
    });
}

TEST_F(DevicePoseTestsOfWorld, FarFromTheOriginAndOfAllSizes) {
    DevicePoseTests tests;
    for_each_case(seed + 3000, 2, [&](Random& random) {
        const Vector2 far{1e6, -3e6};
        const std::vector<InstanceHandle> added = add_some(random, 15.0, far);
        for (const double size : {0.001, 0.1, 10.0, 1000.0}) {
            const ShapeHandle shape = add_shape(scaled_and_moved(star(random, 12, 0.5), size, {}));
            compare_poses(tests, {.shape = shape}, some_poses(random, 200, 20.0, far));
        }
        remove(added);
    });
}

/// Shapes that touch, overlap exactly, or share edges: all are left to the CPU that single
/// precision cannot tell.
TEST_F(DevicePoseTestsOfWorld, AmongTilesThatTouch) {
    DevicePoseTests tests;
    Random random(seed + 4000);
    add_tiles();
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    std::vector<Pose> poses;
    for (int i = 0; i < 500; ++i) {
        poses.push_back({place_of_tiles(random), 0.0});
        poses.back().translation.x -= random.whole(0, 1) * 1.5;
        poses.back().translation.y += random.whole(0, 1) * 4.0;
    }
    EXPECT_GT(compare_poses(tests, {.shape = square}, poses), 100U);
    EXPECT_GT(tests.left_to_cpu(), 0U);
}

TEST_F(DevicePoseTestsOfWorld, ConsiderFilters) {
    DevicePoseTests tests;
    Random random(seed + 5000);
    consider_filters(random, [&](ShapeHandle square, const WorldFilter& filter) {
        const std::size_t hits =
            compare_poses(tests, {square, filter}, some_poses(random, 200, 8.0));
        EXPECT_LT(hits, 150U);
    });
}

TEST_F(DevicePoseTestsOfWorld, OfSmallWorldsAndRefusals) {
    DevicePoseTests tests;
    Random random(seed + 6000);
    const ShapeHandle shape = add_shape(star(random, 5, 0.5));
    const ShapeHandle tiny = add_shape(scaled_and_moved(star(random, 9, 0.5), 1e-11, {}));
    const std::vector<Pose> poses = some_poses(random, 100, 2.0);
    EXPECT_EQ(compare_poses(tests, {.shape = shape}, poses), 0U);
    EXPECT_EQ(compare_poses(tests, {.shape = shape}, {}), 0U);
    add(shape, {});
    EXPECT_GT(compare_poses(tests, {.shape = shape}, poses), 10U);
    // A shape that is too small for single precision, where there is something.
    compare_poses(tests, {.shape = tiny}, poses);
    EXPECT_GT(tests.left_to_cpu(), 0U);
    std::vector<std::uint8_t> found(poses.size());
    EXPECT_EQ(tests.collect(found).code(), StatusCode::not_ready);
    EXPECT_EQ(world().submit(tests, {}, poses).code(), StatusCode::unknown_shape);
    EXPECT_EQ(
        world().submit(tests, {.shape = shape}, std::vector<Pose>{{{0.0, 1e300}, 0.0}}).code(),
        StatusCode::invalid_query);
    ASSERT_TRUE(world().submit(tests, {.shape = shape}, poses).ok());
    EXPECT_EQ(world().submit(tests, {.shape = shape}, poses).code(), StatusCode::not_ready);
    EXPECT_EQ(tests.collect({}).code(), StatusCode::invalid_query);
    EXPECT_TRUE(tests.collect(found).ok());
}

/// The shape may be removed too before they are collected.
TEST_F(DevicePoseTestsOfWorld, TellOfTheWorldAsItWas) {
    DevicePoseTests tests;
    Random random(seed + 7000);
    const std::vector<InstanceHandle> added = add_tiles();
    const ShapeHandle shape = *context().add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    std::vector<Pose> poses = some_poses(random, 100, 9.0);
    for (int i = 0; i < 100; ++i) {
        poses.push_back({place_of_tiles(random), 0.0});
        poses.back().translation.x -= 2.0;
    }
    std::vector<std::uint8_t> expected(poses.size());
    std::vector<std::uint8_t> found(poses.size());
    ASSERT_TRUE(world().test_poses({.shape = shape}, poses, expected).ok());
    ASSERT_TRUE(world().submit(tests, {.shape = shape}, poses).ok());
    remove(added);
    ASSERT_TRUE(context().remove_shape(shape).ok());
    ASSERT_TRUE(tests.collect(found).ok());
    EXPECT_EQ(found, expected);
    EXPECT_GT(tests.left_to_cpu(), 0U);
}

}  // namespace
}  // namespace nearfield::test
