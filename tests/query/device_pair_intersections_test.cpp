#include <tests/limits/cut.hpp>
#include <tests/query/device_pairs.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 25000;

/// The pairs of a world that intersect, found by the device, compared with those of the CPU.
class DevicePairIntersections : public DevicePairsTest {
protected:
    /// What a test asks of a world again and again.
    struct Tables {
        DevicePairTable<IntersectionTestQuery> device{IntersectionTestQuery{}};
        PairTable<IntersectionTestQuery> cpu{IntersectionTestQuery{}, {.hits_only = true}};
    };

    /// Updates both tables, and compares their rows.
    void compare(Tables& tables) {
        const Status status = world().update(tables.device);
        ASSERT_TRUE(status.ok()) << status.message();
        ASSERT_TRUE(world().update(tables.cpu).ok());
        ASSERT_EQ(tables.device.size(), tables.cpu.rows().size());
        EXPECT_GE(tables.device.candidates(), tables.device.size());
        for (std::uint32_t i = 0; i < tables.device.size(); ++i) {
            const PairRow<IntersectionTestQuery>& truth = tables.cpu.rows()[i];
            const auto row = tables.device.row(i);
            ASSERT_TRUE(row.has_value()) << row.error().message();
            ASSERT_EQ(row->a, truth.a) << "row " << i;
            ASSERT_EQ(row->b, truth.b) << "row " << i;
            EXPECT_EQ(row->status, truth.status);
            EXPECT_TRUE(row->intersects);
            EXPECT_EQ(row->error_bound, truth.error_bound);
            EXPECT_EQ(row->record_count, 0U);
        }
    }
    void compare() {
        Tables tables;
        compare(tables);
    }
};

TEST_F(DevicePairIntersections, AreThoseOfTheCpu) {
    for_each_case(seed, 12, [&](Random& random) {
        std::vector<InstanceHandle> added;
        std::vector<Rings> shapes = some_shapes(random);
        for (int i = 0; i < 12; ++i) {
            shapes.push_back(any_shape(random).rings);
        }
        for (const Rings& rings : shapes) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = random.whole(1, 5); i > 0; --i) {
                added.push_back(add(shape, any_pose(random, 6.0)));
            }
        }
        Tables tables;
        compare(tables);
        EXPECT_GT(tables.device.size(), 10U);
        EXPECT_LT(tables.device.left_to_cpu(), tables.device.candidates() / 20);
        remove(added);
    });
}

/// Small shapes in all places of large ones with holes and parts: outside, inside, in a hole, and
/// across a boundary.
TEST_F(DevicePairIntersections, OfShapesInHolesAreNone) {
    for_each_case(seed + 1000, 4, [&](Random& random) {
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
        Tables tables;
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
    compare();
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
    Tables tables;
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
    Tables tables;
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
    Tables tables;
    compare(tables);
    EXPECT_GT(tables.device.size(), 0U);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

TEST_F(DevicePairIntersections, FarFromTheOrigin) {
    for_each_case(seed + 2000, 80, [&](Random& random) {
        std::vector<InstanceHandle> added;
        const double size = random.scale(1e-6, 1.0);
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(scaled_and_moved(rings, size, {}));
            for (int i = 0; i < 3; ++i) {
                Pose pose = any_pose(random, 4.0 * size);
                pose.translation.x += 1e6;
                pose.translation.y -= 3e6;
                added.push_back(add(shape, pose));
            }
        }
        compare();
        remove(added);
    });
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
        compare();
        remove(added);
    }
}

/// Sizes whose ratio is far from 1, and floats that do not hold them.
TEST_F(DevicePairIntersections, OfTheSmallestAndLargestShapes) {
    Random random(seed + 3000);
    for (const double size : {1e-18, 1e-12, 1e-9, 1e-4, 1.0, 1e4, 1e11}) {
        const ShapeHandle shape = add_shape(scaled_and_moved(star(random, 9, 0.5), size, {}));
        const ShapeHandle holes = add_shape(scaled_and_moved(with_holes(random, 3), size, {}));
        for (int i = 0; i < 4; ++i) {
            add(shape, any_pose(random, size));
            add(holes, any_pose(random, size));
        }
    }
    compare();
}

/// Boundaries whose boxes do not tell their edges apart.
TEST_F(DevicePairIntersections, OfTangles) {
    for_each_case(seed + 4000, 3, [&](Random& random) {
        std::vector<InstanceHandle> added;
        for (const int n : {30, 300, 3000}) {
            const ShapeHandle shape = add_shape(tangle(random, n));
            const ShapeHandle other = add_shape(spiky(random, n));
            for (int i = 0; i < 3; ++i) {
                added.push_back(add(shape, any_pose(random, 3.0)));
                added.push_back(add(other, any_pose(random, 3.0)));
            }
        }
        compare();
        remove(added);
    });
}

TEST_F(DevicePairIntersections, DoNotShowTheirHistory) {
    Random random(seed + 5000);
    Tables tables;
    run_history(random, {.steps = 10, .instances = 200, .extent = 25.0}, [&] { compare(tables); });
}

/// Cut at any checkpoint an update fails as a whole, and the next one is as if nothing had been.
/// The same instances at the same poses, of which one is filtered otherwise.
TEST_F(DevicePairIntersections, FollowAFilterThatChanges) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    const InstanceHandle one = add(square, {});
    add(square, {.translation = {0.5, 0.5}});
    Tables tables;
    compare(tables);
    EXPECT_EQ(tables.device.size(), 1U);
    ASSERT_TRUE(world().set_filter(one, 1, 0).ok());
    compare(tables);
    EXPECT_EQ(tables.device.size(), 0U);
}

TEST_F(DevicePairIntersections, CutByLimitsAreNone) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 8; ++i) {
        add(square, {.translation = {i / 3.0 + i, 0.0}});
        add(square, {.translation = {i / 3.0 + i + 1.0, 0.5}});
    }
    Tables tables;
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
    EXPECT_GE(cuts, 8U);
}

TEST_F(DevicePairIntersections, HaveNoRecords) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.5, 0.5}});
    DevicePairTable table(IntersectionTestQuery{});
    ASSERT_TRUE(world().update(table).ok());
    ASSERT_EQ(table.size(), 1U);
    std::vector<NoRecord> records;
    EXPECT_EQ(table.records(0, records).code(), StatusCode::invalid_query);
    EXPECT_FALSE(table.row(1).has_value());
}

}  // namespace
}  // namespace nearfield::test
