#include <tests/query/device_pairs.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 26000;

/// Contacts of all pairs of a world that the device finds, compared with those of the CPU.
class DevicePairContacts : public DevicePairsTest {
protected:
    /// What a test asks of a world again and again.
    struct Tables {
        explicit Tables(const ContactQuery& query)
            : device(query), cpu(query, {.hits_only = true}) {}

        DevicePairTable<ContactQuery> device;
        PairTable<ContactQuery> cpu;
    };

    static void expect_equal(const ContactRecord& found, const ContactRecord& truth,
                             double tolerance) {
        EXPECT_NEAR(found.distance, truth.distance, tolerance / 1000.0);
        EXPECT_EQ(found.point.x, truth.point.x);
        EXPECT_EQ(found.point.y, truth.point.y);
        EXPECT_EQ(found.on, truth.on);
        EXPECT_EQ(found.inside, truth.inside);
        if (truth.unique && found.unique) {
            EXPECT_NEAR(found.nearest.x, truth.nearest.x, 0.1 * tolerance + 0.1 * truth.distance);
            EXPECT_NEAR(found.nearest.y, truth.nearest.y, 0.1 * tolerance + 0.1 * truth.distance);
        }
    }

    void expect_manifold(Tables& tables, std::uint32_t index, const PairRow<ContactQuery>& truth) {
        ContactQuery query = tables.cpu.query();
        query.technique = Technique::cpu;
        query.a = instance_of(truth.a);
        query.b = instance_of(truth.b);
        Batch batch;
        batch.add(query);
        Results results;
        ASSERT_TRUE(context().run(batch, results).ok());
        const auto& expected = std::get<ContactResult>(results.results.front()).manifold;
        std::vector<ContactCluster> manifold;
        ASSERT_TRUE(tables.device.manifold(index, manifold).ok());
        ASSERT_EQ(manifold.size(), expected.size()) << "row " << index;
        const double near = query.tolerance / 100.0;
        for (std::size_t i = 0; i < manifold.size(); ++i) {
            EXPECT_NEAR(manifold[i].first.x, expected[i].first.x, near);
            EXPECT_NEAR(manifold[i].last.y, expected[i].last.y, near);
            EXPECT_NEAR(manifold[i].normal.x, expected[i].normal.x, 1e-3);
            EXPECT_NEAR(manifold[i].extreme.distance, expected[i].extreme.distance, near);
        }
    }

    /// Updates both tables, and compares their rows and records.
    void compare(Tables& tables) {
        const Status status = world().update(tables.device);
        ASSERT_TRUE(status.ok()) << status.message();
        ASSERT_TRUE(world().update(tables.cpu).ok());
        const ContactQuery& query = tables.cpu.query();
        std::uint32_t next = 0;
        std::vector<ContactRecord> records;
        for (const PairRow<ContactQuery>& truth : tables.cpu.rows()) {
            ASSERT_LT(next, tables.device.size());
            const auto row = tables.device.row(next);
            ASSERT_TRUE(row.has_value()) << row.error().message();
            ASSERT_EQ(row->a, truth.a) << "row " << next;
            ASSERT_EQ(row->b, truth.b) << "row " << next;
            EXPECT_EQ(row->status, truth.status);
            EXPECT_EQ(row->count, truth.count) << "row " << next;
            EXPECT_EQ(row->record_count, query.records ? truth.count : 0) << "row " << next;
            EXPECT_EQ(row->intersects, truth.intersects) << "row " << next;
            EXPECT_EQ(row->error_bound, truth.error_bound);
            if (query.records) {
                ASSERT_TRUE(tables.device.records(next, records).ok());
                const auto all = tables.cpu.records(truth);
                ASSERT_EQ(records.size(), all.size()) << "row " << next;
                for (std::size_t i = 0; i < all.size(); ++i) {
                    expect_equal(records[i], all[i], query.tolerance);
                }
            }
            if (next % 16 == 0 && truth.status == StatusCode::ok) {
                expect_manifold(tables, next, truth);
            }
            ++next;
        }
        EXPECT_EQ(next, tables.device.size());
    }

    [[nodiscard]] Instance instance_of(InstanceHandle handle) {
        const Expected<WorldInstance> instance = world().instance(handle);
        EXPECT_TRUE(instance.has_value());
        return {instance->shape, instance->pose};
    }
};

TEST_F(DevicePairContacts, AreThoseOfTheCpu) {
    for_each_case(seed, 6, [&](Random& random) {
        std::vector<InstanceHandle> added;
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = random.whole(1, 4); i > 0; --i) {
                added.push_back(add(shape, any_pose(random, 5.0)));
            }
        }
        const double tolerance = random.scale(3e-3, 0.1);
        Tables tables(
            {.tolerance = tolerance, .contact_distance = tolerance * random.scale(0.2, 20.0)});
        compare(tables);
        EXPECT_GT(tables.device.size(), 10U);
        remove(added);
    });
}

/// Shapes that only come near each other: whatever is in reach, and nothing else.
TEST_F(DevicePairContacts, OfShapesThatAreApart) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 12; ++i) {
        add(square, {.translation = {10.0 * i, 0.0}});
        add(square, {.translation = {10.0 * i + 1.01 + 0.03 * i, 0.25}});
    }
    Tables tables({.tolerance = 0.02, .contact_distance = 0.2, .records = false});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 14U);
    EXPECT_EQ(tables.device.candidates(), 14U);
}

/// Gaps and overlaps that single precision does not resolve: which of them intersect, the CPU
/// tells.
TEST_F(DevicePairContacts, OfShapesThatAlmostTouch) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 60; ++i) {
        const double x = i / 3.0 + 4.0 * i;
        const double gap = std::ldexp(i % 2 == 0 ? 1.0 : -1.0, -20 - i % 20);
        add(square, {.translation = {x, 0.0}});
        add(square, {.translation = {x + 1.0 + gap, 0.3}});
    }
    Tables tables({.tolerance = 0.05, .contact_distance = 0.1});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 120U);
}

/// Far from all boundaries, and where boundaries cross between the samples.
TEST_F(DevicePairContacts, OfShapesThatIntersectWithoutOne) {
    const ShapeHandle large = add_shape({rectangle({-10.0, -10.0}, {10.0, 10.0}).front(),
                                         rectangle({-2.0, -2.0}, {2.0, 2.0}).front()});
    const ShapeHandle small = add_shape(rectangle({-0.25, -0.25}, {0.25, 0.25}));
    const ShapeHandle bar = add_shape(rectangle({-30.0, -0.01}, {30.0, 0.01}));
    add(large, {});
    for (const double x : {0.0, 1.7, 2.0, 5.0, 9.5, 10.2, 12.0}) {
        add(small, {.translation = {x, 0.0}, .angle = 0.2});
    }
    add(bar, {.translation = {0.0, 6.0}, .angle = 0.1});
    Tables tables({.tolerance = 1.0, .contact_distance = 1e-3});
    compare(tables);
    EXPECT_GT(tables.device.size(), 10U);
    Tables near({.tolerance = 0.01, .contact_distance = 0.02});
    compare(near);
    EXPECT_GT(near.device.size(), 10U);
}

/// Points at the contact distance itself, up to rounding; and squares that touch.
TEST_F(DevicePairContacts, AtTheContactDistance) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    std::vector<InstanceHandle> added;
    for (int i = 0; i < 12; ++i) {
        added.push_back(add(square, {.translation = {i / 3.0 + 4.0 * i, 0.0}}));
        added.push_back(
            add(square, {.translation = {i / 3.0 + 4.0 * i + (i % 2 == 0 ? 1.25 : 1.0), 0.5}}));
    }
    Tables tables({.tolerance = 0.05, .contact_distance = 0.25});
    compare(tables);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
}

TEST_F(DevicePairContacts, FarFromTheOrigin) {
    for_each_case(seed + 1000, 3, [&](Random& random) {
        std::vector<InstanceHandle> added;
        for (const Rings& rings : some_shapes(random)) {
            const ShapeHandle shape = add_shape(rings);
            for (int i = 0; i < 2; ++i) {
                Pose pose = any_pose(random, 4.0);
                pose.translation.x += 1e6;
                pose.translation.y -= 3e6;
                added.push_back(add(shape, pose));
            }
        }
        Tables tables({.tolerance = 0.02, .contact_distance = 0.05});
        compare(tables);
        remove(added);
    });
}

/// Edges shorter than a cell have no sample: shapes intersect without a contact, by their
/// crossings.
TEST_F(DevicePairContacts, OfBoundariesWithoutSamples) {
    const ShapeHandle circle = add_shape(regular(64));
    for (int i = 0; i < 24; ++i) {
        const double angle = 0.1 * i;
        add(circle, {.translation = {10.0 * i, 0.0}});
        add(circle, {.translation = {10.0 * i + 1.95 * std::cos(angle), 1.95 * std::sin(angle)}});
    }
    Tables tables({.tolerance = 0.5, .contact_distance = 0.01, .records = false});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 48U);
}

/// More points than the loops of a shader may take turns, in both directions together.
TEST_F(DevicePairContacts, OfManyPoints) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.001, 0.001}});  // 40,000 samples each, all of them contacts
    for (int i = 0; i < 6; ++i) {
        add(square, {.translation = {0.999, -0.9 + 0.3 * i}});
    }
    Tables tables({.tolerance = 7e-5, .contact_distance = 0.005, .records = false});
    compare(tables);
    EXPECT_GT(tables.device.size(), 10U);
}

/// Some drivers add up the loops of neighbouring threads: one compares many points, another follows
/// rays from many rings.
TEST_F(DevicePairContacts, OfManyPointsBesideManyRings) {
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
    Tables tables({.tolerance = 1.5e-4, .contact_distance = 0.002, .records = false});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 6U);
}

TEST_F(DevicePairContacts, DoNotShowTheirHistory) {
    Random random(seed + 2000);
    Tables tables({.tolerance = 0.05, .contact_distance = 0.1});
    run_history(random, {.steps = 8, .instances = 100, .extent = 20.0}, [&] { compare(tables); });
}

/// A tolerance that the coordinates of one instance do not resolve is an error of its pairs alone.
TEST_F(DevicePairContacts, StateTheErrorsOfTheirPairs) {
    const ShapeHandle small = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    add(small, {});
    add(small, {.translation = {0.5, 0.5}});
    add(add_shape(rectangle({-1e9, -1.0}, {1e9, 1.0})), {});
    Tables tables({.tolerance = 1e-4, .contact_distance = 1e-3, .records = false});
    ASSERT_TRUE(world().update(tables.device).ok());
    ASSERT_EQ(tables.device.size(), 6U);
    EXPECT_EQ(tables.device.left_to_cpu(), 4U);
    const auto row = tables.device.row(1);
    ASSERT_TRUE(row.has_value());
    EXPECT_NE(row->status, StatusCode::ok);
}

/// More points of one instance than buffers can hold, or of all than they may.
TEST_F(DevicePairContacts, BeyondTheDeviceAreRefused) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 8; ++i) {
        add(square, {.translation = {0.1 * i, 0.05 * i}});
    }
    DevicePairTable table(ContactQuery{.tolerance = 2e-6, .contact_distance = 1.0});
    const Status status = world().update(table);
    EXPECT_EQ(status.code(), StatusCode::too_large) << status.message();
    EXPECT_NE(status.message().find("the pairs of "), std::string::npos) << status.message();
    EXPECT_EQ(table.size(), 0U);
}

TEST_F(DevicePairContacts, AreTheSameInEachRun) {
    Random random(seed + 3000);
    for (const Rings& rings : some_shapes(random)) {
        const ShapeHandle shape = add_shape(rings);
        for (int i = 0; i < 6; ++i) {
            add(shape, any_pose(random, 8.0));
        }
    }
    const ContactQuery query{.tolerance = 0.02, .contact_distance = 0.05};
    DevicePairTable first(query);
    ASSERT_TRUE(world().update(first).ok());
    std::vector<ContactRecord> one;
    std::vector<ContactRecord> other;
    for (int run = 0; run < 2; ++run) {
        DevicePairTable second(query);
        ASSERT_TRUE(world().update(second).ok());
        ASSERT_EQ(first.size(), second.size());
        for (std::uint32_t i = 0; i < first.size(); ++i) {
            ASSERT_TRUE(first.records(i, one).ok());
            ASSERT_TRUE(second.records(i, other).ok());
            ASSERT_EQ(one.size(), other.size());
            for (std::size_t k = 0; k < one.size(); ++k) {
                EXPECT_EQ(one[k].point.x, other[k].point.x);
                EXPECT_EQ(one[k].distance, other[k].distance);
                EXPECT_EQ(one[k].normal.y, other[k].normal.y);
            }
        }
    }
}

TEST_F(DevicePairContacts, HaveAnalyticNormalsAlone) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.5, 0.5}});
    DevicePairTable table(ContactQuery{
        .tolerance = 0.1, .contact_distance = 0.1, .normals = ContactNormals::gradient});
    EXPECT_EQ(world().update(table).code(), StatusCode::invalid_query);
    DevicePairTable without(
        ContactQuery{.tolerance = 0.1, .contact_distance = 0.1, .records = false});
    ASSERT_TRUE(world().update(without).ok());
    std::vector<ContactRecord> records;
    EXPECT_EQ(without.records(0, records).code(), StatusCode::invalid_query);
    std::vector<ContactCluster> manifold;
    EXPECT_TRUE(without.manifold(0, manifold).ok());
    EXPECT_FALSE(manifold.empty());
    EXPECT_EQ(without.manifold(2, manifold).code(), StatusCode::invalid_query);
}

}  // namespace
}  // namespace nearfield::test
