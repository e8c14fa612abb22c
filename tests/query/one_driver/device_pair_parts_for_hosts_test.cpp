// Searches for pairs in parts, for commands and shaders of a host.

#include <tests/query/device_pair_parts.hpp>
#include <tests/query/host_targets.hpp>
#include <tests/support/host_frames.hpp>

#include <cmath>
#include <cstring>
#include <string>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_parts_for_hosts_seed = 32000;
constexpr std::uint32_t little = 1U << 20U;

using DevicePairPartsForHosts = DevicePairPartsTest;

/// Where two edges are as near, either may be the nearest: points that are searched together
/// differ.
bool are_alike(const PointData& a, const PointData& b) {
    return a.position[0] == b.position[0] && a.position[1] == b.position[1] && a.edge == b.edge &&
           std::abs(a.distance - b.distance) < 1e-6F;
}

TEST_F(DevicePairPartsForHosts, AreRecordedWithRoomForWhatTheyFound) {
    ASSERT_NO_FATAL_FAILURE(make_small(little));
    make_crowd(device_pair_parts_for_hosts_seed, 200, 2.5);
    const PenetrationQuery query{.tolerance = 0.02};
    auto [whole, in_parts, dispatches] = tables_of(query);
    ASSERT_TRUE(world().update(whole).ok());
    test_support::HostFrames frames(host_device(), 1);
    Status status;
    std::uint64_t frame = 0;
    for (bool is_complete = false; !is_complete && frame < 12; ++frame) {
        const VkCommandBuffer commands = frames.begin(frame);
        calls_of_parts.dispatches = 0;
        status = small_world().record(in_parts, {.commands = commands, .frame = frame});
        ASSERT_TRUE(status.ok()) << status.text();
        frames.submit(frame);
        frames.wait(frame);
        small_context().frame_completed(frame);
        status = in_parts.collect();
        is_complete = status.ok();
        EXPECT_TRUE(is_complete || status.code() == StatusCode::overflow) << status.text();
        EXPECT_EQ(small_world().is_recorded(in_parts), is_complete);
    }
    ASSERT_TRUE(status.ok()) << status.text();
    EXPECT_GE(calls_of_parts.dispatches / dispatches, 3);
    EXPECT_TRUE(numbers_of_parts(in_parts) == numbers_of_parts(whole));
    ASSERT_TRUE(in_parts.collect().ok());
    EXPECT_TRUE(numbers_of_parts(in_parts) == numbers_of_parts(whole));
}

/// The parts follow one another.
TEST_F(DevicePairPartsForHosts, LeaveTheSamePenetrationsOnTheDevice) {
    ASSERT_NO_FATAL_FAILURE(make_small(little));
    make_crowd(device_pair_parts_for_hosts_seed + 1, 140, 3.0);
    for (const bool records : {true, false}) {
        const PenetrationQuery query{.tolerance = 0.05,
                                     .points = PenetrationPoints::vertices,
                                     .summary_only = !records,
                                     .on_device = true};
        auto [whole, in_parts, dispatches] = tables_of(query);
        ASSERT_TRUE(world().update(whole).ok());
        const Status status = small_world().update(in_parts);
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_GE(calls_of_parts.dispatches / dispatches, 2);
        const PairContents expected = read(*whole.on_device());
        const PairContents found = read(*in_parts.on_device());
        EXPECT_GT(expected.pairs.size(), 500U);
        ASSERT_EQ(found.pairs.size(), expected.pairs.size());
        ASSERT_EQ(found.points.size(), expected.points.size());
        for (std::size_t i = 0; i < expected.pairs.size(); ++i) {
            ASSERT_EQ(std::memcmp(&found.pairs[i], &expected.pairs[i], sizeof(PairData)), 0) << i;
        }
        for (std::size_t i = 0; i < expected.points.size(); ++i) {
            ASSERT_TRUE(are_alike(found.points[i], expected.points[i])) << i;
        }
    }
}

/// Later parts wait for earlier ones, and the host's uses for all.
TEST_F(DevicePairPartsForHosts, LeaveThemInBuffersOfTheHost) {
    ASSERT_NO_FATAL_FAILURE(make_small(little));
    make_crowd(device_pair_parts_for_hosts_seed + 1, 140, 3.0);
    const PenetrationQuery query{
        .tolerance = 0.05, .points = PenetrationPoints::vertices, .on_device = true};
    auto [whole, in_parts, dispatches] = tables_of(query);
    ASSERT_TRUE(small_world().update(whole).ok());
    const PairContents expected = read(*whole.on_device());
    const HostBuffer pairs(gpu(), expected.pairs.size() * sizeof(PairData), true);
    const HostBuffer points(gpu(), (expected.points.size() - 1) * sizeof(PointData), true);
    PairTarget target{pairs.target(), points.target()};
    // As read() leaves them.
    target.pairs.before = target.points.before = read_by_shaders;
    target.pairs.after = target.points.after = read_by_shaders;
    const Status status = small_world().update(in_parts, {.target = &target});
    EXPECT_EQ(status.code(), StatusCode::overflow) << status.text();
    EXPECT_GE(calls_of_parts.dispatches / dispatches, 2);
    PairsOnDevice left = *in_parts.on_device();
    left.state = {read_by_shaders.stages, read_by_shaders.access, VK_IMAGE_LAYOUT_UNDEFINED, 0};
    const PairContents found = read(left);
    EXPECT_EQ(found.pair_header.overflow + found.point_header.overflow, 2U);
    ASSERT_EQ(found.pairs.size(), expected.pairs.size());
    ASSERT_EQ(found.points.size() + 1, expected.points.size());
    for (std::size_t i = 0; i < found.points.size(); ++i) {
        ASSERT_EQ(std::memcmp(&found.points[i], &expected.points[i], sizeof(PointData)), 0) << i;
    }
}

/// Each part has all records that its rows name, whose instances may be those of other parts.
TEST_F(DevicePairPartsForHosts, LeaveTheSameContactsOnTheDevice) {
    ASSERT_NO_FATAL_FAILURE(make_small(little));
    make_crowd(device_pair_parts_for_hosts_seed + 2, 60, 2.0);
    const ContactQuery query{.tolerance = 0.1, .contact_distance = 0.05, .on_device = true};
    auto [whole, in_parts, dispatches] = tables_of(query);
    ASSERT_TRUE(world().update(whole).ok());
    const Status status = small_world().update(in_parts);
    ASSERT_TRUE(status.ok()) << status.text();
    EXPECT_GE(calls_of_parts.dispatches / dispatches, 2);
    const PairContents expected = read(*whole.on_device());
    const PairContents found = read(*in_parts.on_device());
    EXPECT_GE(found.points.size(), expected.points.size());
    ASSERT_EQ(found.pairs.size(), expected.pairs.size());
    for (std::size_t i = 0; i < expected.pairs.size(); ++i) {
        const PairData& one = expected.pairs[i];
        const PairData& other = found.pairs[i];
        ASSERT_TRUE(one.a == other.a && one.b == other.b && one.count == other.count &&
                    one.flags == other.flags)
            << i;
        ASSERT_EQ(one.point_count, other.point_count);
        ASSERT_EQ(one.count_of_b, other.count_of_b);
        for (std::uint32_t k = 0; k < one.point_count; ++k) {
            ASSERT_TRUE(are_alike(expected.points[one.first_point + k],
                                  found.points[other.first_point + k]));
        }
        for (std::uint32_t k = 0; k < one.count_of_b; ++k) {
            ASSERT_TRUE(
                are_alike(expected.points[one.first_of_b + k], found.points[other.first_of_b + k]));
        }
    }
}

/// The host's shaders have to reach all that stays.
TEST_F(DevicePairPartsForHosts, RefuseWhatTheHostCannotReach) {
    ASSERT_NO_FATAL_FAILURE(make_small(little));
    make_crowd(device_pair_parts_for_hosts_seed + 3, 250, 2.5);
    PairTable<PenetrationQuery> table({.tolerance = 0.02, .on_device = true}, on_device);
    const Status status = small_world().update(table);
    EXPECT_EQ(status.code(), StatusCode::too_large) << status.text();
    EXPECT_NE(status.message().find("the pairs that stay need"), std::string::npos)
        << status.text();
}

}  // namespace
}  // namespace nearfield::test
