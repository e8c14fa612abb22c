#include <nearfield/device_poses.hpp>

#include <tests/query/device_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pairs_seed = 24000;

/// Penetrations of all pairs of a world that the device finds, compared with those of the CPU.
class DevicePairs : public DevicePairsTest {};

/// More instances than three levels of boxes hold, sizes from 1/1000 to 10, and one below them all.
TEST_F(DevicePairs, OfManyInstancesOfAllSizes) {
    Random random(device_pairs_seed + 2000);
    std::vector<ShapeHandle> shapes;
    for (const double size : {0.001, 0.01, 0.1, 1.0}) {
        shapes.push_back(add_shape(scaled_and_moved(star(random, 12, 0.5), size, {0.0, 0.0})));
    }
    add(add_shape(rectangle({-100.0, -100.0}, {100.0, 100.0})), {});
    for (int i = 0; i < 700; ++i) {
        add(shapes[static_cast<std::size_t>(i % 4)], any_pose(random, 10.0));
    }
    Tables<PenetrationQuery> tables(
        {.tolerance = 1e-4, .points = PenetrationPoints::vertices, .summary_only = true});
    compare(tables);
    EXPECT_GT(tables.device.size(), 700U);
}

/// Boxes are as tight as near the origin where all move far away, and beside one that does.
TEST_F(DevicePairs, AreFewWhereverTheInstancesGo) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    std::vector<InstanceHandle> added;
    std::vector<Pose> poses;
    for (int i = 0; i < 30; ++i) {
        poses.push_back({{0.75 * i, 0.25 * i}, 0.1 * i});
        added.push_back(add(square, poses.back()));
    }
    add(square, {.translation = {1e12, 0.0}});
    Tables<PenetrationQuery> tables(
        {.tolerance = 0.01, .points = PenetrationPoints::vertices, .summary_only = true});
    compare(tables);
    const std::uint32_t few = tables.device.candidates();
    EXPECT_LT(few, 150U);
    for (int update = 0; update < 70; ++update) {
        for (Pose& pose : poses) {
            pose.translation.x += update == 0 ? 1e8 : 1.0;
        }
        ASSERT_TRUE(world().move(added, poses).ok());
        ASSERT_TRUE(world().update(tables.device).ok());
    }
    compare(tables);
    EXPECT_NEAR(tables.device.candidates(), few, 2.0);
}

/// Single precision cannot tell on which side of each other's boundary their corners lie.
TEST_F(DevicePairs, OfSquaresThatTouchAreNone) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int x = 0; x < 6; ++x) {
        for (int y = 0; y < 6; ++y) {
            add(square, {.translation = {x / 3.0 + x, y + y / 3.0}});
            add(square, {.translation = {x / 3.0 + x + 1.0, y + y / 3.0}});
        }
    }
    Tables<PenetrationQuery> tables({.tolerance = 1e-5, .points = PenetrationPoints::vertices});
    compare(tables);
    EXPECT_GT(tables.device.candidates(), 0U);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// An error is the row of a pair that is asked about: boxes apart by less than the device tells are
/// none.
TEST_F(DevicePairs, OfBoxesThatAreApartHaveNoErrors) {
    const Expected<ShapeHandle> coarse =
        context().add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}), 0.02);
    ASSERT_TRUE(coarse.has_value()) << coarse.error().text();
    add(*coarse, {});
    const InstanceHandle other = add(*coarse, {.translation = {1.0 + 5e-7, 0.0}});
    Tables<PenetrationQuery> tables({.tolerance = 0.1});
    compare(tables);
    EXPECT_EQ(tables.device.left_to_cpu(), 2U);
    EXPECT_EQ(tables.device.size(), 0U);
    ASSERT_TRUE(world().move(other, {{0.5, 0.0}, 0.0}).ok());
    compare(tables);
    EXPECT_EQ(tables.device.size(), 2U);
    EXPECT_TRUE(context().remove_shape(*coarse).ok());
}

/// Edges with more samples than a number of 32 bits counts are refused, as by the CPU.
TEST_F(DevicePairs, OfMoreSamplesThanTheDeviceCounts) {
    add(add_shape(rectangle({0.0, 0.0}, {1.0, 1.0})), {});
    add(add_shape(scaled_and_moved(regular(16), 40.0, {0.56, 0.0})), {});
    const double cell = 1.0 / (4294967296.0 + 7.5);
    Tables<PenetrationQuery> tables(
        {.tolerance = cell / std::numbers::sqrt2, .summary_only = true});
    EXPECT_EQ(world().update(tables.device).code(), StatusCode::too_large);
    EXPECT_EQ(tables.device.size(), 0U);
    EXPECT_EQ(world().update(tables.cpu).code(), StatusCode::too_large);
}

/// A tolerance that the coordinates of one instance do not resolve is an error of its pairs alone.
TEST_F(DevicePairs, StateTheErrorsOfTheirPairs) {
    const ShapeHandle small = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    add(small, {});
    add(small, {.translation = {0.5, 0.5}});
    add(add_shape(rectangle({-1e9, -1.0}, {1e9, 1.0})), {});
    Tables<PenetrationQuery> tables({.tolerance = 1e-6, .points = PenetrationPoints::vertices});
    compare(tables);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// Likewise of pairs with more samples than any buffer holds.
TEST_F(DevicePairs, StateTheErrorsOfPairsWithManySamples) {
    const ShapeHandle small = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(small, {});
    add(small, {.translation = {0.5, 0.25}, .angle = 0.1});
    const ShapeHandle land = add_shape(rectangle({-1e9, -1e9}, {1e9, 1e9}));
    add(land, {});
    add(land, {.translation = {1e8, 0.0}, .angle = 1.0});
    Tables<PenetrationQuery> tables({.tolerance = 3e-4, .summary_only = true});
    compare(tables);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// Rows are those of the last update, whatever happens to the world in between.
TEST_F(DevicePairs, StayAsTheyWere) {
    const ShapeHandle shape = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    const InstanceHandle one = add(shape, {});
    add(shape, {.translation = {1.5, 0.25}});
    PairTable table(PenetrationQuery{.tolerance = 0.01}, on_device);
    ASSERT_TRUE(world().update(table).ok());
    ASSERT_EQ(table.size(), 2U);
    const auto before = table.row(0);
    const std::size_t count = points_of(table, 1).size();
    ASSERT_TRUE(world().move(one, {.translation = {50.0, 0.0}}).ok());
    ASSERT_TRUE(context().update_shape(shape, rectangle({-3.0, -3.0}, {3.0, 3.0})).ok());
    const auto after = table.row(0);
    ASSERT_TRUE(before.has_value() && after.has_value());
    EXPECT_EQ(before->count, after->count);
    EXPECT_EQ(before->deepest.depth, after->deepest.depth);
    EXPECT_EQ(points_of(table, 1).size(), count);
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.size(), 0U);
}

/// The same instances at the same poses, whose shape alone is another.
TEST_F(DevicePairs, FollowAShapeThatDeforms) {
    const ShapeHandle shape = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    add(shape, {});
    add(shape, {.translation = {4.0, 0.25}});
    PairTable table(PenetrationQuery{.tolerance = 0.01}, on_device);
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.size(), 0U);
    ASSERT_TRUE(context().update_shape(shape, rectangle({-3.0, -3.0}, {3.0, 3.0})).ok());
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.size(), 2U);
}

/// Pairs of the caller's own list: any, some twice, some of an instance with itself.
TEST_F(DevicePairs, OfAListAreThoseOfTheCpu) {
    Random random(device_pairs_seed + 6000);
    std::vector<InstanceHandle> instances;
    for (const Rings& rings : some_shapes(random)) {
        instances.push_back(add(add_shape(rings), any_pose(random, 1.0)));
    }
    std::vector<InstanceHandle> a;
    std::vector<InstanceHandle> b;
    for (int pair = 0; pair < 100; ++pair) {
        const auto any = [&] {
            return instances[static_cast<std::size_t>(
                random.whole(0, static_cast<int>(instances.size()) - 1))];
        };
        a.push_back(any());
        b.push_back(any());
    }
    const auto compare_lists = [&]<class Query>(const Query& query) {
        for (const bool hits_only : {false, true}) {
            Tables<Query> tables(query);
            PairTableOptions options{.hits_only = hits_only, .listed = true};
            options.technique = Technique::compute;
            tables.device = PairTable<Query>(query, options);
            options.technique = Technique::cpu;
            tables.cpu = PairTable<Query>(query, options);
            compare(tables, {.a = a, .b = b});
            EXPECT_EQ(tables.device.candidates(), a.size());
            EXPECT_EQ(tables.device.left_to_cpu(), 0U);
        }
    };
    compare_lists(PenetrationQuery{.tolerance = 0.02});
    compare_lists(PenetrationQuery{
        .tolerance = 0.02, .points = PenetrationPoints::vertices, .summary_only = true});
    compare_lists(ContactQuery{.tolerance = 0.02, .contact_distance = 0.05});
    compare_lists(SeparationQuery{.tolerance = 0.02});
}

/// What stays on the device, and what is there, is of pairs that the device finds.
TEST_F(DevicePairs, OfAListAreReadByTheHost) {
    const InstanceHandle one[] = {add(add_shape(rectangle({0.0, 0.0}, {1.0, 1.0})), {})};
    const PairTableOptions options{.listed = true, .technique = Technique::compute};
    const auto refused = [&](auto query, const DevicePoses* poses = nullptr) {
        PairTable table(query, options);
        return world().update(table, {.a = one, .b = one, .poses = poses});
    };
    const DevicePoses poses{};
    for (const Status& status : {refused(PenetrationQuery{.tolerance = 0.1, .on_device = true}),
                                 refused(PenetrationQuery{.tolerance = 0.1}, &poses)}) {
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_NE(status.message().find("the table has a list of pairs"), std::string::npos)
            << status.message();
    }
    EXPECT_EQ(refused(IntersectionTestQuery{}).code(), StatusCode::invalid_query);
}

}  // namespace
}  // namespace nearfield::test
