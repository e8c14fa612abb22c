#include <tests/limits/cut.hpp>
#include <tests/query/device_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 24000;

/// Penetrations of all pairs of a world that the device finds, compared with those of the CPU.
class DevicePairs : public DevicePairsTest {
protected:
    /// What a test asks of a world again and again.
    struct Tables {
        explicit Tables(const PenetrationQuery& query) : device(query), cpu(query) {}

        DevicePairTable<PenetrationQuery> device;
        PairTable<PenetrationQuery> cpu;
    };

    static void expect_equal(const PenetrationRecord& found, const PenetrationRecord& truth,
                             double tolerance) {
        const double near = tolerance / 1000.0;
        EXPECT_NEAR(found.depth, truth.depth, near);
        EXPECT_EQ(found.point.x, truth.point.x);
        EXPECT_EQ(found.point.y, truth.point.y);
        if (truth.unique && found.unique) {
            EXPECT_NEAR(found.nearest.x, truth.nearest.x, 0.1 * tolerance + 0.1 * truth.depth);
            EXPECT_NEAR(found.nearest.y, truth.nearest.y, 0.1 * tolerance + 0.1 * truth.depth);
        }
    }

    /// Updates both tables, and compares their rows and records.
    void compare(Tables& tables) {
        const Status status = world().update(tables.device);
        ASSERT_TRUE(status.ok()) << status.message();
        ASSERT_TRUE(world().update(tables.cpu).ok());
        const double tolerance = tables.cpu.query().tolerance;
        std::uint32_t next = 0;
        std::vector<PenetrationRecord> records;
        for (const PairRow<PenetrationQuery>& truth : tables.cpu.rows()) {
            if (truth.count == 0 && truth.status == StatusCode::ok) {
                continue;
            }
            ASSERT_LT(next, tables.device.size());
            const auto row = tables.device.row(next);
            ASSERT_TRUE(row.has_value()) << row.error().message();
            ASSERT_EQ(row->a, truth.a) << "row " << next;
            ASSERT_EQ(row->b, truth.b) << "row " << next;
            EXPECT_EQ(row->status, truth.status);
            EXPECT_EQ(row->count, truth.count) << "row " << next;
            EXPECT_EQ(row->intersects, truth.intersects);
            EXPECT_EQ(row->error_bound, truth.error_bound);
            if (truth.status == StatusCode::ok) {
                expect_equal(row->deepest, truth.deepest, tolerance);
            }
            if (tables.cpu.query().records) {
                ASSERT_TRUE(tables.device.records(next, records).ok());
                const auto all = tables.cpu.records(truth);
                ASSERT_EQ(records.size(), all.size()) << "row " << next;
                for (std::size_t i = 0; i < all.size(); ++i) {
                    expect_equal(records[i], all[i], tolerance);
                }
            }
            ++next;
        }
        EXPECT_EQ(next, tables.device.size());
    }
};

TEST_F(DevicePairs, AreThoseOfTheCpu) {
    for_each_case(seed, 6, [&](Random& random) {
        for (const PenetrationPoints points :
             {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
            std::vector<InstanceHandle> added;
            for (const Rings& rings : some_shapes(random)) {
                const ShapeHandle shape = add_shape(rings);
                for (int i = random.whole(1, 5); i > 0; --i) {
                    added.push_back(add(shape, any_pose(random, 5.0)));
                }
            }
            Tables tables({.tolerance = random.scale(1e-3, 0.1), .points = points});
            compare(tables);
            remove(added);
        }
    });
}

TEST_F(DevicePairs, DoNotShowTheirHistory) {
    for_each_case(seed + 1000, 2, [&](Random& random) {
        Tables tables({.tolerance = 0.05, .points = PenetrationPoints::vertices});
        run_history(random, {.steps = 12, .instances = 150, .extent = 25.0},
                    [&] { compare(tables); });
    });
}

/// More instances than three levels of boxes hold, sizes from 1/1000 to 10, and one below them all.
TEST_F(DevicePairs, OfManyInstancesOfAllSizes) {
    Random random(seed + 2000);
    std::vector<ShapeHandle> shapes;
    for (const double size : {0.001, 0.01, 0.1, 1.0}) {
        shapes.push_back(add_shape(scaled_and_moved(star(random, 12, 0.5), size, {0.0, 0.0})));
    }
    add(add_shape(rectangle({-100.0, -100.0}, {100.0, 100.0})), {});
    for (int i = 0; i < 700; ++i) {
        add(shapes[static_cast<std::size_t>(i % 4)], any_pose(random, 10.0));
    }
    Tables tables({.tolerance = 1e-4, .points = PenetrationPoints::vertices, .records = false});
    compare(tables);
    EXPECT_GT(tables.device.size(), 700U);
}

TEST_F(DevicePairs, FarFromTheOrigin) {
    for_each_case(seed + 3000, 3, [&](Random& random) {
        std::vector<InstanceHandle> added;
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = 0; i < 3; ++i) {
                Pose pose = any_pose(random, 4.0);
                pose.translation.x += 1e6;
                pose.translation.y -= 3e6;
                added.push_back(add(shape, pose));
            }
        }
        Tables tables({.tolerance = 0.01});
        compare(tables);
        remove(added);
    });
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
    Tables tables({.tolerance = 0.01, .points = PenetrationPoints::vertices, .records = false});
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
    Tables tables({.tolerance = 1e-5, .points = PenetrationPoints::vertices});
    compare(tables);
    EXPECT_GT(tables.device.candidates(), 0U);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// Cut at any checkpoint, those of the pairs that the CPU decides included, an update fails as a
/// whole, and the next one is as if nothing had been.
TEST_F(DevicePairs, CutByLimitsAreNone) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 8; ++i) {
        add(square, {.translation = {i / 3.0 + i, 0.0}});
        add(square, {.translation = {i / 3.0 + i + 1.0, 0.5}});
    }
    Tables tables({.tolerance = 1e-5, .points = PenetrationPoints::vertices});
    const std::uint64_t cuts = cut_everywhere(dense, [&](std::uint64_t n) {
        SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
        const Cut cut(n);
        const Status status = world().update(tables.device, cut.limits());
        EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok)
            << status.text();
        if (cut.has_cut()) {
            EXPECT_EQ(tables.device.size(), 0U);
        }
        compare(tables);
        EXPECT_GT(tables.device.left_to_cpu(), 0U);
        return cut.has_cut() && !HasFailure();
    });
    EXPECT_GE(cuts, 12U);
}

/// The CPU answers what floats may not hold: products of the least and the largest lengths.
TEST_F(DevicePairs, OfTheSmallestAndLargestShapes) {
    for (const double size : {1e-18, 1e-12, 1e11}) {
        SCOPED_TRACE("size " + std::to_string(size));
        Random random(seed + 6000);
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 4; ++i) {
            const ShapeHandle shape =
                add_shape(scaled_and_moved(star(random, 9, 0.5), size, {0.0, 0.0}));
            for (int k = 0; k < 2; ++k) {
                added.push_back(add(shape, any_pose(random, size)));
            }
        }
        Tables tables({.tolerance = 0.01 * size, .points = PenetrationPoints::vertices});
        compare(tables);
        EXPECT_GT(tables.device.size(), 0U);
        remove(added);
    }
}

/// An error is the row of a pair that is asked about: boxes apart by less than the device tells are
/// none.
TEST_F(DevicePairs, OfBoxesThatAreApartHaveNoErrors) {
    const Expected<ShapeHandle> coarse =
        context().add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}), 0.02);
    ASSERT_TRUE(coarse.has_value()) << coarse.error().text();
    add(*coarse, {});
    const InstanceHandle other = add(*coarse, {.translation = {1.0 + 5e-7, 0.0}});
    Tables tables({.tolerance = 0.1});
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
    Tables tables({.tolerance = cell / std::numbers::sqrt2, .records = false});
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
    Tables tables({.tolerance = 1e-6, .points = PenetrationPoints::vertices});
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
    Tables tables({.tolerance = 3e-4, .records = false});
    compare(tables);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// Rows are those of the last update, whatever happens to the world in between.
TEST_F(DevicePairs, StayAsTheyWere) {
    const ShapeHandle shape = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    const InstanceHandle one = add(shape, {});
    add(shape, {.translation = {1.5, 0.25}});
    DevicePairTable table(PenetrationQuery{.tolerance = 0.01});
    ASSERT_TRUE(world().update(table).ok());
    ASSERT_EQ(table.size(), 2U);
    const auto before = table.row(0);
    std::vector<PenetrationRecord> records;
    ASSERT_TRUE(table.records(1, records).ok());
    const std::size_t count = records.size();
    ASSERT_TRUE(world().move(one, {.translation = {50.0, 0.0}}).ok());
    ASSERT_TRUE(context().update_shape(shape, rectangle({-3.0, -3.0}, {3.0, 3.0})).ok());
    const auto after = table.row(0);
    ASSERT_TRUE(before.has_value() && after.has_value());
    EXPECT_EQ(before->count, after->count);
    EXPECT_EQ(before->deepest.depth, after->deepest.depth);
    ASSERT_TRUE(table.records(1, records).ok());
    EXPECT_EQ(records.size(), count);
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.size(), 0U);
}

/// The same instances at the same poses, whose shape alone is another.
TEST_F(DevicePairs, FollowAShapeThatDeforms) {
    const ShapeHandle shape = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    add(shape, {});
    add(shape, {.translation = {4.0, 0.25}});
    DevicePairTable table(PenetrationQuery{.tolerance = 0.01});
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.size(), 0U);
    ASSERT_TRUE(context().update_shape(shape, rectangle({-3.0, -3.0}, {3.0, 3.0})).ok());
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.size(), 2U);
}

/// The order of the rows and every bit of them are the same in each run.
TEST_F(DevicePairs, AreTheSameInEachRun) {
    Random random(seed + 4000);
    for (const Rings& rings : some_shapes(random)) {
        const ShapeHandle shape = add_shape(rings);
        for (int i = 0; i < 12; ++i) {
            add(shape, any_pose(random, 8.0));
        }
    }
    const PenetrationQuery query{.tolerance = 0.02};
    DevicePairTable first(query);
    ASSERT_TRUE(world().update(first).ok());
    for (int run = 0; run < 3; ++run) {
        DevicePairTable second(query);
        ASSERT_TRUE(world().update(second).ok());
        ASSERT_EQ(first.size(), second.size());
        for (std::uint32_t i = 0; i < first.size(); ++i) {
            const auto one = first.row(i);
            const auto other = second.row(i);
            ASSERT_TRUE(one.has_value() && other.has_value());
            EXPECT_EQ(one->a, other->a);
            EXPECT_EQ(one->b, other->b);
            EXPECT_EQ(one->count, other->count);
            EXPECT_EQ(one->deepest.depth, other->deepest.depth);
            EXPECT_EQ(one->deepest.point.x, other->deepest.point.x);
        }
    }
}

TEST_F(DevicePairs, BeyondTheMemoryLimitAreRefused) {
    Settings settings;
    settings.memory_limit = 1U << 21U;
    Expected<Context> limited = Context::create(host_device(), settings);
    ASSERT_TRUE(limited.has_value());
    Random random(seed + 5000);
    const auto shape = limited->add_shape(star(random, 50, 0.5));
    ASSERT_TRUE(shape.has_value());
    Expected<World> world = World::create(*limited);
    ASSERT_TRUE(world.has_value());
    std::vector<InstanceHandle> handles;
    for (int i = 0; i < 300; ++i) {
        const auto handle = world->add({.shape = *shape, .pose = any_pose(random, 1.0)});
        ASSERT_TRUE(handle.has_value());
        handles.push_back(*handle);
    }
    DevicePairTable table(PenetrationQuery{.tolerance = 0.01});
    const Status status = world->update(table);
    EXPECT_EQ(status.code(), StatusCode::too_large) << status.message();
    EXPECT_NE(status.message().find("memory_limit"), std::string::npos) << status.message();
    EXPECT_EQ(table.size(), 0U);
    for (std::size_t i = 2; i < handles.size(); ++i) {
        ASSERT_TRUE(world->remove(handles[i]).ok());
    }
    EXPECT_TRUE(world->update(table).ok());
}

/// Buffers start small where the usual ones do not fit.
TEST_F(DevicePairs, WithinALimitBelowTheUsualRoom) {
    Settings settings;
    settings.memory_limit = 1U << 17U;
    Expected<Context> limited = Context::create(host_device(), settings);
    ASSERT_TRUE(limited.has_value()) << limited.error().text();
    const auto shape = limited->add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    ASSERT_TRUE(shape.has_value());
    Expected<World> world = World::create(*limited);
    ASSERT_TRUE(world.has_value());
    for (const double x : {0.0, 0.5}) {
        ASSERT_TRUE(world->add({.shape = *shape, .pose = {{x, x}, 0.0}}).has_value());
    }
    DevicePairTable table(PenetrationQuery{.tolerance = 0.01});
    const Status status = world->update(table);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(table.size(), 2U);
}

TEST_F(DevicePairs, OfAnEmptyWorldAreNone) {
    Tables tables({.tolerance = 0.1});
    compare(tables);
    const InstanceHandle only = add(add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0})), {});
    compare(tables);
    compare(tables);
    ASSERT_TRUE(world().move(only, {{1.0, 2.0}, 0.5}).ok());
    compare(tables);
    EXPECT_EQ(tables.device.size(), 0U);
    EXPECT_FALSE(tables.device.row(0).has_value());
}

}  // namespace
}  // namespace nearfield::test
