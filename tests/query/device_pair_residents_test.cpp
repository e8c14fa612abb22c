#include <tests/query/device_pairs.hpp>
#include <tests/query/host_targets.hpp>

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

    static inline std::uint64_t frame_ = 1000;  // of the context, which tests share
    std::uint32_t rows_ = 0;                    // that were compared
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

/// Two buffers of the host.
struct HostPairs {
    HostPairs(test_support::HostGpu& gpu, std::uint64_t rows, std::uint64_t records,
              bool has_headers)
        : pairs(gpu, rows * sizeof(PairData), has_headers),
          points(gpu, records * sizeof(PointData), has_headers) {}

    [[nodiscard]] PairTarget target() const { return {pairs.target(), points.target()}; }
    void fill(VkCommandBuffer commands) const {
        pairs.fill(commands);
        points.fill(commands);
    }
    void use(VkCommandBuffer commands) const {
        pairs.use(commands);
        points.use(commands);
    }

    HostBuffer pairs;
    HostBuffer points;
};

std::vector<std::uint32_t> words_of(const void* data, std::size_t bytes) {
    std::vector<std::uint32_t> words(bytes / sizeof(std::uint32_t));
    std::memcpy(words.data(), data, words.size() * sizeof(std::uint32_t));
    return words;
}

/// The buffer has these first elements in its range, the header where there is one, and elsewhere
/// what the host has written.
template <class Data>
void expect_in(const HostBuffer& buffer, const std::vector<Data>& all, const HeaderData& header) {
    std::vector<std::uint32_t> expected = buffer.words();
    const std::vector<std::uint32_t> words = expected;
    std::fill(expected.begin(), expected.end(), HostBuffer::pattern);
    const auto put = [&](std::uint64_t offset, const std::vector<std::uint32_t>& part) {
        std::copy(part.begin(), part.end(),
                  expected.begin() + static_cast<std::ptrdiff_t>(offset / sizeof(std::uint32_t)));
    };
    put(buffer.target().offset, words_of(all.data(), all.size() * sizeof(Data)));
    if (buffer.target().header_offset) {
        put(*buffer.target().header_offset, words_of(&header, sizeof(header)));
    }
    EXPECT_TRUE(words == expected);
}

/// All within a command buffer, whose hazards the validation layers see.
TEST_F(DevicePairResidents, GoToBuffersOfTheHost) {
    Random random(device_pair_residents_seed + 1);
    const ShapeHandle shape = add_shape(star(random, 12, 0.6));
    for (int i = 0; i < 30; ++i) {
        add(shape, any_pose(random, 2.0));
    }
    const ContactQuery query{.tolerance = 0.02, .contact_distance = 0.05, .on_device = true};
    PairTable own(query, on_device);
    ASSERT_TRUE(world().update(own).ok());
    const PairContents all = read(*own.on_device());
    ASSERT_GT(all.pairs.size(), 100U);
    ASSERT_GT(all.points.size(), 500U);
    PairTable table(query, on_device);
    std::set<std::uint64_t> revisions;
    for (const bool has_headers : {true, false, true}) {
        const HostPairs host(gpu(), all.pairs.size() + 7, all.points.size() + 9, has_headers);
        const PairTarget target = host.target();
        PairsOnDevice left;
        gpu().submit([&](VkCommandBuffer commands) {
            host.fill(commands);
            ASSERT_TRUE(
                world()
                    .record(table, {.commands = commands, .frame = ++frame_}, {.target = &target})
                    .ok());
            left = *table.on_device();
            host.use(commands);
        });
        gpu().finish();
        context().frame_completed(frame_);
        const Status status = table.collect();
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(numbers_of_table(table), numbers_of_table(own));
        expect_in(host.pairs, all.pairs, all.pair_header);
        expect_in(host.points, all.points, all.point_header);
        EXPECT_EQ(left.pairs.buffer, target.pairs.buffer);
        EXPECT_EQ(left.points.offset, target.points.offset);
        EXPECT_EQ(left.pairs.capacity, all.pairs.size() + 7);
        EXPECT_EQ(left.pairs.header.buffer == target.pairs.buffer, has_headers);
        EXPECT_TRUE(revisions.insert(left.revision).second);
        if (!has_headers) {
            const auto header = gpu().read(left.points.header.buffer, left.points.header.offset,
                                           sizeof(HeaderData), left.state);
            EXPECT_EQ(header, words_of(&all.point_header, sizeof(HeaderData)));
        }
        // Without a target they are nearfield's own again, also of a table that searches itself.
        ASSERT_TRUE(
            world()
                .submit(table, has_headers ? PairTableInput{.target = &target} : PairTableInput{})
                .ok());
        ASSERT_TRUE(table.collect().ok());
        EXPECT_EQ(table.on_device()->pairs.buffer == target.pairs.buffer, has_headers);
        EXPECT_TRUE(revisions.insert(table.on_device()->revision).second || has_headers);
        if (!has_headers) {
            EXPECT_EQ(read(*table.on_device()).points.size(), all.points.size());
        }
    }
}

/// A target that is too small has what fits, and says so; the rows of the table are all there.
TEST_F(DevicePairResidents, ThatDoNotFitBuffersOfTheHostAreCutOff) {
    Random random(device_pair_residents_seed + 2);
    const ShapeHandle shape = add_shape(star(random, 12, 0.6));
    for (int i = 0; i < 30; ++i) {
        add(shape, any_pose(random, 2.0));
    }
    const PenetrationQuery query{.tolerance = 0.02, .on_device = true};
    PairTable own(query, on_device);
    ASSERT_TRUE(world().update(own).ok());
    const PairContents all = read(*own.on_device());
    const auto rows = static_cast<std::uint32_t>(all.pairs.size());
    const auto records = static_cast<std::uint32_t>(all.points.size());
    ASSERT_GT(rows, 100U);
    ASSERT_GT(records, 500U);
    PairTable table(query, on_device);
    ASSERT_TRUE(world().update(table).ok());  // has room for all now
    for (const auto& [pairs, points] :
         {std::pair{rows - 1, records}, std::pair{rows, records - 1}, std::pair{rows / 2, 1U},
          std::pair{1U, records / 2}, std::pair{rows, records}}) {
        SCOPED_TRACE(std::to_string(pairs) + " pairs, " + std::to_string(points) + " points");
        const bool fits = pairs == rows && points == records;
        const HostPairs host(gpu(), pairs, points, true);
        const PairTarget target = host.target();
        gpu().submit([&](VkCommandBuffer commands) {
            host.fill(commands);
            ASSERT_TRUE(
                world()
                    .record(table, {.commands = commands, .frame = ++frame_}, {.target = &target})
                    .ok());
            host.use(commands);
        });
        gpu().finish();
        context().frame_completed(frame_);
        for (int i = 0; i < 2; ++i) {
            const Status status = table.collect();
            EXPECT_EQ(status.code(), fits ? StatusCode::ok : StatusCode::overflow) << status.text();
            EXPECT_EQ(numbers_of_table(table), numbers_of_table(own));
            EXPECT_EQ(table.found().rows, rows);
            EXPECT_EQ(table.capacity().rows, pairs);
            EXPECT_EQ(table.capacity().points, points);
            EXPECT_EQ(world().is_recorded(table), fits);
        }
        PairContents cut = all;
        cut.pairs.resize(pairs);
        cut.points.resize(points);
        for (PairData& pair : cut.pairs) {
            const std::uint32_t left = points - std::min(points, pair.first_point);
            pair.point_count = std::min(pair.point_count, left);
            if (pair.deepest != no_point && pair.deepest >= points) {
                pair.deepest = no_point;
                pair.depth = 0.0F;
            }
        }
        const auto header_of = [fits](HeaderData header, std::uint32_t count) {
            header.count = header.points.vertexCount = header.quads.instanceCount = count;
            header.groups.x = (count + 63) / 64;
            header.overflow = fits ? 0 : 1;
            return header;
        };
        expect_in(host.pairs, cut.pairs, header_of(all.pair_header, pairs));
        expect_in(host.points, cut.points, header_of(all.point_header, points));
        const Status status = world().update(table, {.target = &target});
        EXPECT_EQ(status.code(), fits ? StatusCode::ok : StatusCode::overflow) << status.text();
        EXPECT_EQ(numbers_of_table(table), numbers_of_table(own));
        if (!fits) {
            ASSERT_EQ(status.reasons().size(),
                      (pairs < rows ? 1U : 0U) + (points < records ? 1U : 0U));
            const std::size_t needed =
                points < records ? records * sizeof(PointData) : rows * sizeof(PairData);
            EXPECT_NE(status.reasons().back().find(std::to_string(needed)), std::string::npos)
                << status.text();
        }
    }
}

TEST_F(DevicePairResidents, DoNotGoToBadBuffers) {
    const ShapeHandle square = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    add(square, {});
    add(square, {.translation = {0.5, 0.0}});
    const HostPairs host(gpu(), 64, 1024, true);
    PairTable table(PenetrationQuery{.tolerance = 0.05, .on_device = true}, on_device);
    const auto refuse = [&](const std::string& words, const auto& spoil) {
        PairTarget target = host.target();
        spoil(target);
        const Status status = world().update(table, {.target = &target});
        EXPECT_EQ(status.code(), StatusCode::invalid_query) << words;
        EXPECT_NE(status.message().find("update: "), std::string::npos) << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos) << status.text();
    };
    refuse("buffer of pairs is null", [](auto& target) { target.pairs.buffer = VK_NULL_HANDLE; });
    refuse("buffer of points is null", [](auto& target) { target.points.buffer = VK_NULL_HANDLE; });
    refuse("the first point may take 40", [](auto& target) { target.points.size = 39; });
    refuse("lacks VK_BUFFER_USAGE_STORAGE_BUFFER_BIT",
           [](auto& target) { target.pairs.usage = 2; });
    refuse("lacks VK_BUFFER_USAGE_TRANSFER_DST_BIT",
           [](auto& target) { target.points.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT; });
    refuse("has bytes in common with that of pairs",
           [](auto& target) { target.points = target.pairs; });
    const PairTarget target = host.target();
    PairTable not_left(PenetrationQuery{.tolerance = 0.05}, on_device);
    PairTable by_cpu(PenetrationQuery{.tolerance = 0.05}, on_cpu);
    for (PairTable<PenetrationQuery>* const other : {&not_left, &by_cpu}) {
        const Status status = world().update(*other, {.target = &target});
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_NE(status.message().find("leaves nothing on the device"), std::string::npos);
    }
    EXPECT_TRUE(world().update(table, {.target = &target}).ok());
    EXPECT_EQ(table.size(), 2U);
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
