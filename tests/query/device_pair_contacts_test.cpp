#include <tests/query/device_pairs.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_contacts_seed = 26000;

/// Contacts of all pairs of a world that the device finds, compared with those of the CPU.
class DevicePairContacts : public DevicePairsTest {};

/// Shapes that only come near each other: whatever is in reach, and nothing else.
TEST_F(DevicePairContacts, OfShapesThatAreApart) {
    const ShapeHandle square = add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    for (int i = 0; i < 12; ++i) {
        add(square, {.translation = {10.0 * i, 0.0}});
        add(square, {.translation = {10.0 * i + 1.01 + 0.03 * i, 0.25}});
    }
    Tables<ContactQuery> tables({.tolerance = 0.02, .contact_distance = 0.2, .summary_only = true});
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
    Tables<ContactQuery> tables({.tolerance = 0.05, .contact_distance = 0.1});
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
    Tables<ContactQuery> tables({.tolerance = 1.0, .contact_distance = 1e-3});
    compare(tables);
    EXPECT_GT(tables.device.size(), 10U);
    Tables<ContactQuery> near({.tolerance = 0.01, .contact_distance = 0.02});
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
    Tables<ContactQuery> tables({.tolerance = 0.05, .contact_distance = 0.25});
    compare(tables);
    EXPECT_GT(tables.device.left_to_cpu(), 0U);
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
    Tables<ContactQuery> tables({.tolerance = 0.5, .contact_distance = 0.01, .summary_only = true});
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
    Tables<ContactQuery> tables(
        {.tolerance = 7e-5, .contact_distance = 0.005, .summary_only = true});
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
    Tables<ContactQuery> tables(
        {.tolerance = 1.5e-4, .contact_distance = 0.002, .summary_only = true});
    compare(tables);
    EXPECT_EQ(tables.device.size(), 6U);
}

/// A tolerance that the coordinates of one instance do not resolve is an error of its pairs alone.
TEST_F(DevicePairContacts, StateTheErrorsOfTheirPairs) {
    const ShapeHandle small = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    add(small, {});
    add(small, {.translation = {0.5, 0.5}});
    add(add_shape(rectangle({-1e9, -1.0}, {1e9, 1.0})), {});
    Tables<ContactQuery> tables(
        {.tolerance = 1e-4, .contact_distance = 1e-3, .summary_only = true});
    ASSERT_TRUE(world().update(tables.device).ok());
    ASSERT_EQ(tables.device.size(), 6U);
    EXPECT_EQ(tables.device.left_to_cpu(), 4U);
    const auto row = tables.device.row(1);
    ASSERT_TRUE(row.has_value());
    EXPECT_NE(row->status, StatusCode::ok);
}

TEST_F(DevicePairContacts, HaveAnalyticNormalsAlone) {
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
