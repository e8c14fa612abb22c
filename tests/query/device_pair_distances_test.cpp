#include <tests/query/device_pairs.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_distances_seed = 27000;

/// The pairs of a world that are near each other, found by the device, compared with those of the
/// CPU.
class DevicePairDistances : public DevicePairsTest {
protected:
    using DevicePairsTest::compare;
    void compare(double reach) {
        Tables<SeparationQuery> separations({.tolerance = 0.01}, reach);
        compare(separations);
        Tables<ClosestPointQuery> closest({.tolerance = 0.01}, reach);
        compare(closest);
        EXPECT_EQ(closest.device.size(), 2 * separations.device.size());
    }
};

/// Distances at the reach itself, up to rounding.
TEST_F(DevicePairDistances, AtTheReach) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 12; ++i) {
        add(square, {.translation = {i / 3.0 + 4.0 * i, 0.0}});
        add(square, {.translation = {i / 3.0 + 4.0 * i + (i % 2 == 0 ? 1.25 : 1.0), 0.5}});
    }
    compare(0.25);
    PairTable<SeparationQuery> table({.tolerance = 0.01}, within(0.25, on_device));
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

TEST_F(DevicePairDistances, WithoutAReachAreRefused) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    for (const double reach : {-1.0, std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
        PairTable<SeparationQuery> table({.tolerance = 0.01}, within(reach, on_device));
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
        Tables<SeparationQuery> separations({.tolerance = 1e-6}, reach);
        compare(separations);
        ASSERT_GT(separations.device.size(), 0U);
        EXPECT_EQ(separations.device.row(0)->status, StatusCode::invalid_query);
        Tables<ClosestPointQuery> closest({.tolerance = 1e-6}, reach);
        compare(closest);
        EXPECT_EQ(closest.device.size(), 2 * separations.device.size());
    }
}

}  // namespace
}  // namespace nearfield::test
