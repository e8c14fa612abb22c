#include <tests/query/device_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_residents_seed = 28000;

/// What tables of pairs leave on the device, compared with their exact rows.
class DevicePairResidents : public DevicePairsOfHostTest {
protected:
    PairContents read(const PairsOnDevice& pairs) {
        PairContents all = DevicePairsOfHostTest::read(pairs);
        for (const HeaderData& header : {all.pair_header, all.point_header}) {
            EXPECT_EQ(header.points.vertexCount, header.count);
            EXPECT_EQ(header.points.instanceCount, 1U);
            EXPECT_EQ(header.quads.vertexCount, 6U);
            EXPECT_EQ(header.quads.instanceCount, header.count);
            EXPECT_EQ(header.groups.x, (header.count + 63) / 64);
            EXPECT_EQ(header.groups.y * header.groups.z, 1U);
            EXPECT_EQ(header.origin[0], static_cast<float>(pairs.origin.x));
            EXPECT_EQ(header.origin[1], static_cast<float>(pairs.origin.y));
        }
        return all;
    }

    /// PairsOnDevice states it: most shapes have a radius of about 1, one of 9, and are within 8 of
    /// the origin; for one that is farther away it allows more.
    static constexpr double near = 40.0 * 0x1p-17;

    /// Of the records of a row, that of a point; null if there is none.
    static const PointData* find(const PairContents& all, std::uint32_t first, std::uint32_t count,
                                 const Vector2& origin, const Vector2& point) {
        for (std::uint32_t i = first; i < first + count; ++i) {
            const PointData& one = all.points[i];
            if (std::hypot(origin.x + static_cast<double>(one.position[0]) - point.x,
                           origin.y + static_cast<double>(one.position[1]) - point.y) <= near) {
                return &one;
            }
        }
        return nullptr;
    }

    /// `direction`: out of the other shape.
    void expect_equal(const PointData& found, const Vector2& nearest, const Vector2& direction,
                      double distance, bool unique, const Vector2& origin) {
        EXPECT_NEAR(static_cast<double>(found.distance), distance, near);
        if (unique && (found.feature & feature_bits::unique) != 0) {
            // As far apart as two points of one edge can be that are as near.
            const double apart = 4.0 * std::sqrt(near * (distance + near));
            EXPECT_NEAR(origin.x + static_cast<double>(found.nearest[0]), nearest.x, apart);
            EXPECT_NEAR(origin.y + static_cast<double>(found.nearest[1]), nearest.y, apart);
        }
        const auto x = static_cast<double>(found.normal[0]);
        const auto y = static_cast<double>(found.normal[1]);
        EXPECT_NEAR(std::hypot(x, y), 1.0, 1e-6);
        if ((found.flags & point_flags::touching) != 0) {
            EXPECT_LE(distance, 2.0 * near);
            return;
        }
        const bool is_decided = (found.flags & point_flags::undecided) == 0;
        if (unique && is_decided && distance > 100.0 * near) {
            EXPECT_NEAR(x, direction.x, 0.2);
            EXPECT_NEAR(y, direction.y, 0.2);
            ++normals_;
        }
    }

    /// Updates a table and compares what it left on the device with its rows.
    template <class Query>
    void compare(PairTable<Query>& table) {
        ASSERT_TRUE(world().submit(table).ok());
        const Status status = table.collect();
        ASSERT_TRUE(status.ok()) << status.text();
        const Expected<PairsOnDevice> pairs = table.on_device();
        ASSERT_TRUE(pairs.has_value()) << pairs.error().text();
        const PairContents all = read(*pairs);
        EXPECT_EQ(all.pair_header.overflow + all.point_header.overflow, 0U);
        std::map<std::pair<std::uint32_t, std::uint32_t>, const PairData*> by_pair;
        std::uint32_t undecided = 0;
        for (const PairData& pair : all.pairs) {
            EXPECT_TRUE(by_pair.emplace(std::pair(pair.a, pair.b), &pair).second);
            undecided += (pair.flags & pair_flags::undecided) != 0 ? 1 : 0;
        }
        EXPECT_EQ(undecided, table.left_to_cpu());
        std::uint32_t rows = 0;
        for (std::uint32_t i = 0; i < table.size(); ++i) {
            const auto row = table.row(i);
            ASSERT_TRUE(row.has_value());
            const auto found = by_pair.find({row->a.index, row->b.index});
            ASSERT_NE(found, by_pair.end());
            if ((found->second->flags & pair_flags::undecided) == 0) {
                ++rows;
                ASSERT_NO_FATAL_FAILURE(
                    compare_row(table, i, *row, *found->second, all, pairs->origin));
            }
        }
        EXPECT_EQ(rows + undecided, all.pairs.size());
        rows_ += rows;
    }

    template <class Query>
    void compare_row(PairTable<Query>& table, std::uint32_t i, const PairRow<Query>& row,
                     const PairData& pair, const PairContents& all, const Vector2& origin) {
        SCOPED_TRACE("row " + std::to_string(i));
        ASSERT_LE(pair.first_point + pair.point_count, all.points.size());
        ASSERT_LE(pair.first_of_b + pair.count_of_b, all.points.size());
        if ((pair.flags & pair_flags::uncertain) == 0) {
            EXPECT_EQ(pair.count, row.count);
        }
        if ((pair.flags & pair_flags::intersects) != 0) {
            EXPECT_TRUE(row.intersects);
        }
        for (const auto& one : points_of(table, i)) {
            bool is_of_b = false;
            if constexpr (std::is_same_v<Query, ContactQuery>) {
                is_of_b = one.on == Side::b;
            }
            const PointData* const found =
                is_of_b ? find(all, pair.first_of_b, pair.count_of_b, origin, one.position)
                        : find(all, pair.first_point, pair.point_count, origin, one.position);
            ASSERT_NE(found, nullptr) << one.position.x << " " << one.position.y;
            if constexpr (std::is_same_v<Query, PenetrationQuery>) {
                expect_equal(*found, one.nearest, one.direction, one.depth, one.unique, origin);
            } else {
                const double sign = one.inside ? 1.0 : -1.0;
                const Vector2 direction{sign * (one.nearest.x - one.position.x) / one.distance,
                                        sign * (one.nearest.y - one.position.y) / one.distance};
                expect_equal(*found, one.nearest, direction, one.distance, one.unique, origin);
            }
            ++records_;
        }
        if constexpr (std::is_same_v<Query, PenetrationQuery>) {
            ASSERT_LT(pair.deepest, all.points.size());
            EXPECT_NEAR(static_cast<double>(pair.depth), row.deepest.depth, near);
            EXPECT_NEAR(all.points[pair.deepest].distance, pair.depth, 1e-4F);
            EXPECT_NE(all.points[pair.deepest].feature & feature_bits::inside, 0U);
        } else {
            EXPECT_EQ(pair.deepest, no_point);
        }
    }

    std::uint32_t rows_ = 0;  // that were compared
    std::uint32_t records_ = 0;
    std::uint32_t normals_ = 0;
};

TEST_F(DevicePairResidents, ArePenetrationsAsTheDeviceFindsThem) {
    for_each_case(device_pair_residents_seed, 3, [&](Random& random) {
        for (const PenetrationPoints points :
             {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
            PairTable table(PenetrationQuery{.tolerance = 0.02,
                                             .points = points,
                                             .technique = Technique::compute,
                                             .on_device = true},
                            on_device);
            run_history(random, {4, 40, 5.0}, [&] { compare(table); });
        }
    });
    EXPECT_GT(rows_, 500U);
    EXPECT_GT(records_, 5000U);
    EXPECT_GT(normals_, 100U);
}

TEST_F(DevicePairResidents, AreContactsAsTheDeviceFindsThem) {
    for_each_case(device_pair_residents_seed, 3, [&](Random& random) {
        PairTable table(
            ContactQuery{.tolerance = 0.02, .contact_distance = 0.05, .on_device = true},
            on_device);
        run_history(random, {4, 30, 5.0}, [&] { compare(table); });
    });
    EXPECT_GT(rows_, 200U);
    EXPECT_GT(records_, 2000U);
}

/// There is room for some thousand pairs at first.
TEST_F(DevicePairResidents, SayThatTheyAreNotAllThere) {
    const ShapeHandle square = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    for (int i = 0; i < 120; ++i) {
        add(square, {.translation = {0.01 * i, 0.005 * i}, .angle = 0.1 * i});
    }
    PairTable table(PenetrationQuery{.tolerance = 0.05, .on_device = true}, on_device);
    ASSERT_TRUE(world().submit(table).ok());
    const PairContents before = read(*table.on_device());
    EXPECT_EQ(before.pair_header.overflow, 1U);
    EXPECT_EQ(before.point_header.overflow, 1U);
    const std::uint64_t revision = table.on_device()->revision;
    ASSERT_TRUE(table.collect().ok());
    EXPECT_NE(table.on_device()->revision, revision);
    const PairContents after = read(*table.on_device());
    EXPECT_EQ(after.pair_header.overflow, 0U);
    EXPECT_EQ(after.point_header.overflow, 0U);
    EXPECT_EQ(after.pairs.size(), 120U * 119U);
    EXPECT_EQ(table.size(), 120U * 119U);
    ASSERT_TRUE(world().submit(table).ok());
    EXPECT_EQ(read(*table.on_device()).pairs.size(), 120U * 119U);
    ASSERT_TRUE(table.collect().ok());
}

TEST_F(DevicePairResidents, AreRelativeToTheOriginOfTheHost) {
    const ShapeHandle square = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    const auto buffer = gpu().make_buffer(32, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    const float places[8] = {0.0F, 0.0F, 1.0F, 0.0F, 0.5F, 0.25F, 1.0F, 0.0F};
    std::memcpy(const_cast<std::byte*>(buffer.data), places, sizeof(places));  // it is mapped
    add(square, {});
    add(square, {});
    DevicePoses poses;
    poses.buffer = buffer.buffer;
    poses.size = sizeof(places);
    poses.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    PairTable table(PenetrationQuery{.tolerance = 0.05, .on_device = true}, on_device);
    for (const Vector2& origin : {Vector2{}, Vector2{1000.0, -5.0}, Vector2{7.0, 7.0}}) {
        poses.origin = origin;
        ASSERT_TRUE(world().update(table, at_poses(poses)).ok());
        EXPECT_EQ(table.on_device()->origin, origin);
        EXPECT_EQ(read(*table.on_device()).pairs.size(), 2U);
        EXPECT_NEAR(table.row(0)->deepest.nearest.x, origin.x + 1.0, 1.0);
    }
}

/// Buffers that are made anew may have the handles of former ones.
TEST_F(DevicePairResidents, OfATableThatStartsAnewHaveAnotherRevision) {
    const ShapeHandle square = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.5, 0.0}});
    Expected<World> other = World::create(context());
    ASSERT_TRUE(other.has_value());
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(other->add({.shape = square, .pose = {{0.3 * i, 0.0}, 0.0}}).has_value());
    }
    PairTable table(PenetrationQuery{.tolerance = 0.05, .on_device = true}, on_device);
    std::set<std::uint64_t> revisions;
    for (int i = 0; i < 3; ++i) {
        for (World* const each : {&world(), &*other}) {
            ASSERT_TRUE(each->update(table).ok());
            EXPECT_TRUE(revisions.insert(table.on_device()->revision).second);
        }
    }
}

TEST_F(DevicePairResidents, OfNothingHaveACountOfZero) {
    const ShapeHandle square = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    PairTable table(PenetrationQuery{.tolerance = 0.05, .on_device = true}, on_device);
    EXPECT_EQ(table.on_device().error().code(), StatusCode::not_ready);
    add(square, {});
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.on_device().error().code(), StatusCode::not_ready);
    add(square, {.translation = {5.0, 0.0}});
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(read(*table.on_device()).pairs.size(), 0U);
    PairTable rows_alone(PenetrationQuery{.tolerance = 0.05}, on_device);
    ASSERT_TRUE(world().update(rows_alone).ok());
    EXPECT_EQ(rows_alone.on_device().error().code(), StatusCode::invalid_query);
}

}  // namespace
}  // namespace nearfield::test
