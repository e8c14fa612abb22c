#include <tests/query/device_pairs.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 27000;

/// The pairs of a world that are near each other, found by the device, compared with those of the
/// CPU.
class DevicePairDistances : public DevicePairsTest {
protected:
    /// Updates a table, and compares its rows with those of the CPU.
    template <class Query>
    void compare(double reach, DevicePairTable<Query>& table) {
        const Status status = world().update(table);
        ASSERT_TRUE(status.ok()) << status.message();
        PairTable<Query> cpu(table.query(), {.reach = reach, .hits_only = true});
        ASSERT_TRUE(world().update(cpu).ok());
        ASSERT_EQ(table.size(), cpu.rows().size()) << "reach " << reach;
        for (std::uint32_t i = 0; i < table.size(); ++i) {
            const PairRow<Query>& truth = cpu.rows()[i];
            const auto row = table.row(i);
            ASSERT_TRUE(row.has_value()) << row.error().message();
            ASSERT_EQ(row->a, truth.a) << "row " << i;
            ASSERT_EQ(row->b, truth.b) << "row " << i;
            EXPECT_EQ(row->status, truth.status);
            EXPECT_EQ(row->intersects, truth.intersects);
            EXPECT_EQ(row->distance, truth.distance);
            EXPECT_EQ(row->direction.x, truth.direction.x);
            EXPECT_EQ(row->unique, truth.unique);
            EXPECT_EQ(row->error_bound, truth.error_bound);
        }
    }
    void compare(double reach) {
        DevicePairTable<SeparationQuery> separations({.tolerance = 0.01}, reach);
        compare(reach, separations);
        DevicePairTable<ClosestPointQuery> closest({.tolerance = 0.01}, reach);
        compare(reach, closest);
        EXPECT_LE(separations.size(), separations.candidates());
        EXPECT_EQ(closest.size(), 2 * separations.size());
    }
};

TEST_F(DevicePairDistances, AreThoseOfTheCpu) {
    for_each_case(seed, 5, [&](Random& random) {
        std::vector<InstanceHandle> added;
        std::vector<Rings> shapes = some_shapes(random);
        for (int i = 0; i < 6; ++i) {
            shapes.push_back(any_shape(random).rings);
        }
        for (const Rings& rings : shapes) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = random.whole(1, 3); i > 0; --i) {
                added.push_back(add(shape, any_pose(random, 10.0)));
            }
        }
        for (const double reach : {0.0, 1e-3, random.scale(0.01, 5.0)}) {
            compare(reach);
        }
        DevicePairTable<SeparationQuery> table({.tolerance = 0.01}, 1.0);
        compare(1.0, table);
        EXPECT_GT(table.size(), 10U);
        EXPECT_LT(table.left_to_cpu(), table.candidates() / 20);
        remove(added);
    });
}

/// Distances at the reach itself, up to rounding.
TEST_F(DevicePairDistances, AtTheReach) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 12; ++i) {
        add(square, {.translation = {i / 3.0 + 4.0 * i, 0.0}});
        add(square, {.translation = {i / 3.0 + 4.0 * i + (i % 2 == 0 ? 1.25 : 1.0), 0.5}});
    }
    compare(0.25);
    DevicePairTable<SeparationQuery> table({.tolerance = 0.01}, 0.25);
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_GT(table.left_to_cpu(), 0U);
}

/// Where the sums of coordinates and reach are rounded, both rows of a pair are there, or none.
TEST_F(DevicePairDistances, AtTheReachOfBoxesThatAreRounded) {
    const ShapeHandle bar = add_shape(rectangle({0.0, -1.0}, {2.0, 1.0}));
    const double quarter = 1.5707963267948966;
    for (const double first : {0.0, -3.0}) {
        const std::vector<InstanceHandle> added{
            add(bar, {.translation = {first, 0.0}, .angle = quarter}),
            add(bar, {.translation = {-3.0 - first, 0.0}, .angle = quarter})};
        compare(1.0);
        remove(added);
    }
}

/// A shape in a hole is as far as the hole's boundary; one that is deep inside intersects.
TEST_F(DevicePairDistances, InHoles) {
    const ShapeHandle frame = add_shape(
        {rectangle({-5.0, -5.0}, {5.0, 5.0}).front(), rectangle({-3.0, -3.0}, {3.0, 3.0}).front()});
    const ShapeHandle dot = add_shape(rectangle({-0.25, -0.25}, {0.25, 0.25}));
    add(frame, {});
    for (const double x : {0.0, 1.5, 2.5, 2.7, 4.0, 5.5, 7.0, 9.0}) {
        add(dot, {.translation = {x, 0.0}, .angle = 0.1});
    }
    for (const double reach : {0.1, 0.5, 1.5, 2.74, 2.76, 100.0}) {
        compare(reach);
    }
}

TEST_F(DevicePairDistances, FarFromTheOrigin) {
    for_each_case(seed + 1000, 3, [&](Random& random) {
        std::vector<InstanceHandle> added;
        const double size = random.scale(1e-5, 1.0);
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(scaled_and_moved(rings, size, {}));
            for (int i = 0; i < 2; ++i) {
                Pose pose = any_pose(random, 6.0 * size);
                pose.translation.x += 1e6;
                pose.translation.y -= 3e6;
                added.push_back(add(shape, pose));
            }
        }
        compare(0.3 * size);
        remove(added);
    });
}

TEST_F(DevicePairDistances, OfTheSmallestAndLargestShapes) {
    Random random(seed + 2000);
    for (const double size : {1e-18, 1e-9, 1e-4, 1.0, 1e4, 1e11}) {
        const ShapeHandle shape = add_shape(scaled_and_moved(star(random, 9, 0.5), size, {}));
        for (int i = 0; i < 3; ++i) {
            add(shape, any_pose(random, 3.0 * size));
        }
    }
    for (const double reach : {0.0, 1e-12, 0.1, 1e9}) {
        compare(reach);
    }
}

TEST_F(DevicePairDistances, WithoutAReachAreRefused) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    for (const double reach : {-1.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
        DevicePairTable<SeparationQuery> table({.tolerance = 0.01}, reach);
        const Status status = world().update(table);
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_NE(status.message().find("reach"), std::string::npos) << status.message();
    }
}

/// Coordinates that double precision does not resolve to the tolerance: each row says so.
TEST_F(DevicePairDistances, TooFarAwayAreErrorsOfTheirRows) {
    const ShapeHandle square = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    for (int i = 0; i < 4; ++i) {
        add(square, {.translation = {1e9 + 1.7 * i, 1.7 * (i % 2)}, .angle = 0.7});
    }
    for (const double reach : {0.0, 1.0}) {
        DevicePairTable<SeparationQuery> separations({.tolerance = 1e-6}, reach);
        compare(reach, separations);
        ASSERT_GT(separations.size(), 0U);
        EXPECT_EQ(separations.row(0)->status, StatusCode::invalid_query);
        DevicePairTable<ClosestPointQuery> closest({.tolerance = 1e-6}, reach);
        compare(reach, closest);
        EXPECT_EQ(closest.size(), 2 * separations.size());
    }
}

}  // namespace
}  // namespace nearfield::test
