#include <nearfield/device_poses.hpp>

#include <tests/query/device_pairs.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pairs_seed = 24000;

// What is particular to a query or to a scene; what all have in common:
// device_pair_tables_test.cpp.

using DevicePairs = DevicePairsTest;

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

/// Pairs with more samples than any buffer holds are errors of their rows.
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

/// Where the sums of coordinates and reach are rounded, both rows of a pair are there, or none.
TEST_F(DevicePairs, OfBoxesThatAreRoundedAreAtTheReach) {
    const ShapeHandle bar = add_shape(rectangle({0.0, -1.0}, {2.0, 1.0}));
    const double quarter = std::numbers::pi / 2.0;
    for (const double first : {0.0, -3.0}) {
        const std::vector<InstanceHandle> added{
            add(bar, {.translation = {first, 0.0}, .angle = quarter}),
            add(bar, {.translation = {-3.0 - first, 0.0}, .angle = quarter})};
        compare(SeparationQuery{.tolerance = 0.01}, 1.0);
        compare(ClosestPointQuery{.tolerance = 0.01}, 1.0);
        remove(added);
    }
}

using DevicePairsThatIntersect = DevicePairsTest;

/// Small shapes in all places of large ones with holes and parts: outside, inside, in a hole, and
/// across a boundary.
TEST_F(DevicePairsThatIntersect, OfShapesInHolesAreNone) {
    for_each_case(device_pairs_seed + 1000, 4, [&](Random& random) {
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

/// More rings than the device follows for one pair: those that meet nothing are left to the CPU.
TEST_F(DevicePairsThatIntersect, OfVeryManyRings) {
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
TEST_F(DevicePairsThatIntersect, OfEdgesBesideVeryMany) {
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

/// Boundaries whose boxes do not tell their edges apart.
TEST_F(DevicePairsThatIntersect, OfTangles) {
    for_each_case(device_pairs_seed + 4000, 3, [&](Random& random) {
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

using DevicePairsInContact = DevicePairsTest;

/// Edges shorter than a cell have no sample: shapes intersect without a contact, by their
/// crossings.
TEST_F(DevicePairsInContact, OfBoundariesWithoutSamples) {
    const ShapeHandle circle = add_shape(regular(64));
    for (int i = 0; i < 24; ++i) {
        const double angle = 0.1 * i;
        add(circle, {.translation = {10.0 * i, 0.0}});
        add(circle, {.translation = {10.0 * i + 1.95 * std::cos(angle), 1.95 * std::sin(angle)}});
    }
    Tables<ContactQuery> tables({.tolerance = 0.5, .contact_distance = 0.01, .summary_only = true});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 48U);
}

/// More points than the loops of a shader may take turns, in both directions together.
TEST_F(DevicePairsInContact, OfManyPoints) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.001, 0.001}});  // 40,000 samples each, all of them contacts
    for (int i = 0; i < 6; ++i) {
        add(square, {.translation = {0.999, -0.9 + 0.3 * i}});
    }
    Tables<ContactQuery> tables(
        {.tolerance = 7e-5, .contact_distance = 0.005, .summary_only = true});
    compare(tables);
    EXPECT_GT(tables.device.size(), 10U);
}

/// Some drivers add up the loops of neighbouring threads: one compares many points, another follows
/// rays from many rings.
TEST_F(DevicePairsInContact, OfManyPointsBesideManyRings) {
    const auto dots = [](double offset) {
        Rings rings;
        for (int i = 0; i < 38 * 38; ++i) {
            const Vector2 low{i % 38 / 38.0 + offset, i / 38 / 38.0 + offset};
            rings.push_back(rectangle(low, {low.x + 0.005, low.y + 0.005}).front());
        }
        return rings;
    };
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.0005, 0.0005}});  // 19,000 samples each
    add(add_shape(dots(0.0)), {.translation = {5.0, 5.0}});
    add(add_shape(dots(0.012)), {.translation = {5.0, 5.0}});
    add(square, {.translation = {5.5, 5.5}});
    Tables<ContactQuery> tables(
        {.tolerance = 1.5e-4, .contact_distance = 0.002, .summary_only = true});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 6U);
}

TEST_F(DevicePairsInContact, HaveAnalyticNormalsAlone) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.5, 0.5}});
    PairTable table(
        ContactQuery{
            .tolerance = 0.1, .contact_distance = 0.1, .normals = ContactNormals::gradient},
        on_device);
    EXPECT_EQ(world().update(table).code(), StatusCode::invalid_query);
    PairTable without(ContactQuery{.tolerance = 0.1, .contact_distance = 0.1, .summary_only = true},
                      on_device);
    ASSERT_TRUE(world().update(without).ok());
    for (const auto& row : without.rows()) {
        EXPECT_TRUE(without.points(row).empty());
        EXPECT_FALSE(without.manifold(row).empty());
    }
    PairRow<ContactQuery> none;
    none.index = 2;
    EXPECT_TRUE(without.manifold(none).empty());
    EXPECT_EQ(without.row(2).error().code(), StatusCode::invalid_query);
}

}  // namespace
}  // namespace nearfield::test
