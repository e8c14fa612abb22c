#include <tests/query/device_pairs.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_intersections_seed = 25000;

/// The pairs of a world that intersect, found by the device, compared with those of the CPU.
class DevicePairIntersections : public DevicePairsTest {};

/// Small shapes in all places of large ones with holes and parts: outside, inside, in a hole, and
/// across a boundary.
TEST_F(DevicePairIntersections, OfShapesInHolesAreNone) {
    for_each_case(device_pair_intersections_seed + 1000, 4, [&](Random& random) {
        std::vector<InstanceHandle> added;
        for (const Rings& rings : {with_holes(random, 5), with_holes(random, 40),
                                   several_parts(random, 4), spiral(2.0, 0.2, 60), pentagram()}) {
            added.push_back(add(add_shape(scaled_and_moved(rings, 10.0, {})), {}));
        }
        const ShapeHandle small = add_shape(scaled_and_moved(star(random, 9, 0.5), 0.05, {}));
        const ShapeHandle parts =
            add_shape(scaled_and_moved(several_parts(random, 3), 0.2, {3.0, 0.0}));
        for (int i = 0; i < 150; ++i) {
            added.push_back(add(i % 4 == 0 ? parts : small, any_pose(random, 11.0)));
        }
        Tables<IntersectionTestQuery> tables(IntersectionTestQuery{});
        compare(tables);
        EXPECT_GT(tables.device.size(), 100U);
        EXPECT_LT(tables.device.left_to_cpu(), 10U);
        remove(added);
    });
}

/// A ring around a hole that is filled, at a distance, by another shape; and rings that alternate.
TEST_F(DevicePairIntersections, OfNestedRings) {
    const auto square = [](double half) { return rectangle({-half, -half}, {half, half}).front(); };
    const ShapeHandle frame = add_shape({square(3.0), square(2.0)});
    const ShapeHandle rings = add_shape({square(6.0), square(5.0), square(4.0), square(3.5)});
    const ShapeHandle dot = add_shape({square(0.25)});
    add(frame, {});
    add(rings, {});
    for (const double x : {0.0, 1.5, 2.5, 3.25, 3.75, 4.5, 5.5, 7.0}) {
        add(dot, {.translation = {x, 0.0}, .angle = 0.1});
        add(dot, {.translation = {0.0, -x}});
    }
    compare(IntersectionTestQuery{});
}

/// More rings than the device follows for one pair: those that meet nothing are left to the CPU.
TEST_F(DevicePairIntersections, OfVeryManyRings) {
    Rings dots;
    for (int x = 0; x < 60; ++x) {
        for (int y = 0; y < 60; ++y) {
            const Vector2 low{1.0 * x, 1.0 * y};
            dots.push_back(rectangle(low, {low.x + 0.5, low.y + 0.5}).front());
        }
    }
    const ShapeHandle many = add_shape(dots);
    const ShapeHandle small = add_shape(rectangle({0.0, 0.0}, {0.2, 0.2}));
    add(many, {});
    add(small, {.translation = {30.6, 30.6}});
    add(small, {.translation = {20.6, 30.1}});
    add(small, {.translation = {30.1, 30.1}});
    add(small, {.translation = {10.4, 50.4}, .angle = 0.2});
    Tables<IntersectionTestQuery> tables(IntersectionTestQuery{});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 2U);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// An edge beside so many others that the device gives up before it finds the one that it crosses.
TEST_F(DevicePairIntersections, OfEdgesBesideVeryMany) {
    Rings dots;
    for (int x = 0; x < 24; ++x) {
        for (int y = 0; y < 24; ++y) {
            const Vector2 low{1.0 * x, 1.0 * y};
            dots.push_back(rectangle(low, {low.x + 0.3, low.y + 0.3}).front());
        }
    }
    const ShapeHandle beside = add_shape(dots);
    dots.push_back(rectangle({45.0, 45.0}, {46.0, 47.0}).front());
    const ShapeHandle across = add_shape(dots);
    add(add_shape({{{-1.0, -0.505}, {60.0, 60.495}, {60.0, 60.505}, {-1.0, -0.495}}}), {});
    const InstanceHandle instance = add(beside, {});
    Tables<IntersectionTestQuery> tables(IntersectionTestQuery{});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 0U);
    EXPECT_EQ(tables.device.candidates(), 1U);
    ASSERT_TRUE(world().remove(instance).ok());
    add(across, {});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 1U);
    EXPECT_EQ(tables.device.left_to_cpu(), 1U);
}

/// Whatever the rounding of their places says: sides that touch, corners on sides, corners on
/// corners, and the same shape twice.
TEST_F(DevicePairIntersections, OfSquaresThatTouch) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int x = 0; x < 6; ++x) {
        for (int y = 0; y < 6; ++y) {
            const Vector2 place{x / 3.0 + x, y / 3.0 + y};
            add(square, {.translation = place});
            add(square, {.translation = {place.x + 1.0, place.y}});
            add(square, {.translation = {place.x + 1.0, place.y + 1.0}});
            if (x == y) {
                add(square, {.translation = place});
                add(square, {.translation = {place.x + 0.25, place.y + 0.25}});
                add(square, {.translation = {place.x, place.y + 1.0 + 1e-14}});
            }
        }
    }
    Tables<IntersectionTestQuery> tables(IntersectionTestQuery{});
    compare(tables);
    EXPECT_GT(tables.device.size(), 0U);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

/// Squares a few roundings of their places apart, or less.
TEST_F(DevicePairIntersections, WithinTheRoundingOfTheirPlacesTouch) {
    for (const double size : {1.0, 1e-5}) {
        const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {size, size}));
        std::vector<InstanceHandle> added;
        for (int i = 0; i < 24; ++i) {
            const double x = 1e6 + 3.0 * i * size;
            added.push_back(add(square, {.translation = {x, 1e6}}));
            added.push_back(add(
                square, {.translation = {x + size + std::ldexp(1.0, i - 44), 1e6 + 0.3 * size}}));
        }
        compare(IntersectionTestQuery{});
        remove(added);
    }
}

/// Boundaries whose boxes do not tell their edges apart.
TEST_F(DevicePairIntersections, OfTangles) {
    for_each_case(device_pair_intersections_seed + 4000, 3, [&](Random& random) {
        std::vector<InstanceHandle> added;
        for (const int n : {30, 300, 3000}) {
            const ShapeHandle shape = add_shape(tangle(random, n));
            const ShapeHandle other = add_shape(spiky(random, n));
            for (int i = 0; i < 3; ++i) {
                added.push_back(add(shape, any_pose(random, 3.0)));
                added.push_back(add(other, any_pose(random, 3.0)));
            }
        }
        compare(IntersectionTestQuery{});
        remove(added);
    });
}

/// The same instances at the same poses, of which one is filtered otherwise.
TEST_F(DevicePairIntersections, FollowAFilterThatChanges) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    const InstanceHandle one = add(square, {});
    add(square, {.translation = {0.5, 0.5}});
    Tables<IntersectionTestQuery> tables(IntersectionTestQuery{});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 1U);
    ASSERT_TRUE(world().set_filter(one, 1, 0).ok());
    compare(tables);
    EXPECT_EQ(tables.device.size(), 0U);
}

TEST_F(DevicePairIntersections, HaveNoRecords) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.5, 0.5}});
    PairTable table(IntersectionTestQuery{}, on_device);
    ASSERT_TRUE(world().update(table).ok());
    ASSERT_EQ(table.size(), 1U);
    EXPECT_TRUE(table.points(*table.row(0)).empty());
    EXPECT_FALSE(table.row(1).has_value());
}

}  // namespace
}  // namespace nearfield::test
