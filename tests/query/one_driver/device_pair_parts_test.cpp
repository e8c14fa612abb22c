// Searches for pairs in parts, where shaders do not reach the memory for all at once: they find
// what one search does, to the bit.

#include <tests/query/device_pair_parts.hpp>

#include <string>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_parts_seed = 31000;
/// Of a buffer: as far as a few thousand pairs of stars.
constexpr std::uint32_t little_memory = 1U << 20U;
constexpr PenetrationQuery summaries{.tolerance = 0.02, .summary_only = true};

class DevicePairParts : public DevicePairPartsTest {
protected:
    /// Updates both tables, and compares them; the second one once more, without growing.
    template <class Query>
    void compare(PairTable<Query>& whole, PairTable<Query>& in_parts) {
        const Status expected = world().update(whole);
        ASSERT_TRUE(expected.ok()) << expected.text();
        const std::vector<double> numbers = numbers_of_parts(whole);
        const Status status = small_world().update(in_parts);
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_TRUE(numbers_of_parts(in_parts) == numbers) << "of " << numbers.size();
        calls_of_parts.submissions = 0;
        ASSERT_TRUE(small_world().update(in_parts).ok());
        EXPECT_EQ(calls_of_parts.submissions, 1);
        EXPECT_TRUE(numbers_of_parts(in_parts) == numbers) << "of " << numbers.size();
    }
    void move_all(Random& random, double extent) {
        for (std::size_t i = 0; i < size_of_both(); ++i) {
            ASSERT_NO_FATAL_FAILURE(move_both(i, any_pose(random, extent)));
        }
    }
    /// How many parts the last commands of a table had.
    [[nodiscard]] int parts(int dispatches) const {
        EXPECT_EQ(calls_of_parts.dispatches % dispatches, 0);
        return calls_of_parts.dispatches / dispatches;
    }
    template <class Query>
    void expect_the_same_in_parts(const Query& query, int stars, int least_parts) {
        ASSERT_NO_FATAL_FAILURE(make_small(little_memory));
        Random random(device_pair_parts_seed);
        add_crowd(random, stars, 3.0);
        auto [whole, in_parts, dispatches] = tables_of(query, within(0.05, on_device));
        for (std::size_t frame = 0; frame < 2; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            ASSERT_NO_FATAL_FAILURE(compare(whole, in_parts));
            EXPECT_GT(whole.size(), 500U);
            EXPECT_GE(parts(dispatches), least_parts);
            ASSERT_NO_FATAL_FAILURE(move_all(random, 3.0));
            ASSERT_NO_FATAL_FAILURE(set_filter_of_both(7 * frame, 2, 1));
        }
    }
};

TEST_F(DevicePairParts, FindTheSamePenetrations) {
    expect_the_same_in_parts(PenetrationQuery{.tolerance = 0.02}, 250, 3);
}

TEST_F(DevicePairParts, FindTheSameVertices) {
    expect_the_same_in_parts(
        PenetrationQuery{.tolerance = 0.02, .points = PenetrationPoints::vertices}, 250, 3);
}

TEST_F(DevicePairParts, FindTheSameSummaries) {
    expect_the_same_in_parts(summaries, 250, 3);
}

/// A pair needs both directions, which may be in different parts.
TEST_F(DevicePairParts, FindTheSameContacts) {
    expect_the_same_in_parts(ContactQuery{.tolerance = 0.05, .contact_distance = 0.05}, 200, 3);
}

/// Instances that were added first have more pairs.
TEST_F(DevicePairParts, FindTheSameTests) {
    expect_the_same_in_parts(IntersectionTestQuery{}, 400, 3);
}

TEST_F(DevicePairParts, FindTheSameSeparations) {
    expect_the_same_in_parts(SeparationQuery{.tolerance = 0.05}, 400, 3);
}

TEST_F(DevicePairParts, FindTheSameClosestPoints) {
    expect_the_same_in_parts(ClosestPointQuery{.tolerance = 0.05}, 400, 3);
}

/// Shapes of all kinds, among them some whose pairs are left to the CPU.
TEST_F(DevicePairParts, FindTheSameAmongAllShapes) {
    ASSERT_NO_FATAL_FAILURE(make_small(little_memory));
    Random random(device_pair_parts_seed + 1);
    for (const Rings& rings : some_shapes(random)) {
        const std::size_t shape = add_shape_to_both(rings);
        for (int i = 0; i < 12; ++i) {
            add_to_both(shape, any_pose(random, 3.0));
        }
    }
    add_to_both(add_shape_to_both(rectangle({-1e9, -1.0}, {1e9, 1.0})), {});
    const PenetrationQuery points{.tolerance = 0.02, .points = PenetrationPoints::vertices};
    const ContactQuery near{.tolerance = 0.05, .contact_distance = 0.1, .summary_only = true};
    auto penetrations = tables_of(points);
    auto contacts = tables_of(near);
    for (int frame = 0; frame < 2; ++frame) {
        ASSERT_NO_FATAL_FAILURE(compare(penetrations.whole, penetrations.in_parts));
        ASSERT_NO_FATAL_FAILURE(compare(contacts.whole, contacts.in_parts));
        EXPECT_GT(penetrations.in_parts.left_to_cpu(), 0U);
        ASSERT_NO_FATAL_FAILURE(move_all(random, 3.0));
    }
}

/// How pairs are divided into parts, and joined again.
class DivisionOfPairs : public DevicePairParts {};

/// Few of the instances have most of the pairs.
TEST_F(DivisionOfPairs, AreDividedWhereThePairsAre) {
    ASSERT_NO_FATAL_FAILURE(make_small(little_memory));
    Random random = make_crowd(device_pair_parts_seed + 2, 60, 40.0);
    add_crowd(random, 120, 1.0);
    add_crowd(random, 200, 40.0);
    auto [whole, in_parts, dispatches] = tables_of(summaries);
    ASSERT_NO_FATAL_FAILURE(compare(whole, in_parts));
    EXPECT_GE(parts(dispatches), 3);
}

/// Worlds of which instances are removed and added again.
TEST_F(DivisionOfPairs, FollowTheInstances) {
    ASSERT_NO_FATAL_FAILURE(make_small(little_memory));
    Random random(device_pair_parts_seed + 3);
    auto [whole, in_parts, dispatches] = tables_of(summaries);
    for (const int count : {200, 30, 220, 3}) {
        SCOPED_TRACE(count);
        while (size_of_both() > static_cast<std::size_t>(count)) {
            remove_last_of_both();
        }
        add_crowd(random, count - static_cast<int>(size_of_both()), 2.0);
        for (int i = 0; i < 3; ++i) {  // each may join two parts
            ASSERT_NO_FATAL_FAILURE(compare(whole, in_parts));
        }
        EXPECT_EQ(parts(dispatches) > 1, count > 100);
    }
}

/// What has moved apart is searched at once again.
TEST_F(DivisionOfPairs, AreJoinedWherePairsAreFew) {
    ASSERT_NO_FATAL_FAILURE(make_small(little_memory));
    Random random = make_crowd(device_pair_parts_seed + 4, 250, 2.0);
    auto [whole, in_parts, dispatches] = tables_of(summaries);
    ASSERT_NO_FATAL_FAILURE(compare(whole, in_parts));
    const int most = parts(dispatches);
    EXPECT_GE(most, 4);
    for (int frame = 0; frame < most; ++frame) {
        ASSERT_NO_FATAL_FAILURE(move_all(random, 40.0));
        ASSERT_NO_FATAL_FAILURE(compare(whole, in_parts));
    }
    EXPECT_EQ(parts(dispatches), 1);
    ASSERT_NO_FATAL_FAILURE(move_all(random, 2.0));
    ASSERT_NO_FATAL_FAILURE(compare(whole, in_parts));
    EXPECT_GE(parts(dispatches), 4);
}

TEST_F(DivisionOfPairs, MakeNothingInASteadyState) {
    ASSERT_NO_FATAL_FAILURE(make_small(little_memory));
    Random random = make_crowd(device_pair_parts_seed + 5, 200, 2.5);
    auto [whole, table, dispatches] = tables_of(PenetrationQuery{.tolerance = 0.02});
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < size_of_both(); ++i) {
        poses.push_back(any_pose(random, 2.5));
    }
    for (int frame = 0; frame < 24; ++frame) {
        for (std::size_t i = 0; i < size_of_both(); ++i) {
            Pose pose = poses[i];
            pose.translation.x += 0.02 * (frame % 4);
            ASSERT_NO_FATAL_FAILURE(move_both(i, pose));
        }
        const int before = calls_of_parts.dispatches;
        calls_of_parts.objects = calls_of_parts.submissions = 0;
        calls_of_parts.allocations_below = 0;
        const std::uint64_t first = test_support::allocation_count_of_this_thread();
        const bool ok = small_world().update(table).ok();
        const std::uint64_t own = test_support::allocation_count_of_this_thread() - first;
        ASSERT_TRUE(ok);
        if (frame >= 16) {
            EXPECT_EQ(own, calls_of_parts.allocations_below);
            EXPECT_EQ(calls_of_parts.objects, 0);
            EXPECT_EQ(calls_of_parts.submissions, 1);
            EXPECT_EQ(calls_of_parts.dispatches, before);
        }
    }
    EXPECT_GE(parts(dispatches), 3);
}

/// All buffers together may have so much.
TEST_F(DivisionOfPairs, KeepToTheLimitOfMemory) {
    Settings settings;
    settings.memory_limit = 6U << 20U;
    ASSERT_NO_FATAL_FAILURE(make_small(1U << 27U, settings));
    make_crowd(device_pair_parts_seed + 6, 250, 2.0);
    auto [whole, in_parts, dispatches] = tables_of(summaries);
    ASSERT_NO_FATAL_FAILURE(compare(whole, in_parts));
    EXPECT_GE(parts(dispatches), 2);
    PairTable<PenetrationQuery> too_large({.tolerance = 0.001}, on_device);
    const Status status = small_world().update(too_large);
    EXPECT_EQ(status.code(), StatusCode::too_large) << status.text();
    EXPECT_NE(status.message().find("Settings::memory_limit is 6291456"), std::string::npos)
        << status.text();
    EXPECT_EQ(too_large.size(), 0U);
}

/// More points of one instance than buffers can hold.
TEST_F(DivisionOfPairs, RefuseWhatOneInstanceHasTooMuchOf) {
    ASSERT_NO_FATAL_FAILURE(make_small(little_memory));
    make_crowd(device_pair_parts_seed + 7, 10, 0.5);
    PairTable penetrations(PenetrationQuery{.tolerance = 1e-5}, on_device);
    PairTable contacts(ContactQuery{.tolerance = 1e-5, .contact_distance = 1.0}, on_device);
    for (PairTableBase* const table :
         {static_cast<PairTableBase*>(&penetrations), static_cast<PairTableBase*>(&contacts)}) {
        const Status status = small_world().update(*table);
        EXPECT_EQ(status.code(), StatusCode::too_large) << status.text();
        EXPECT_NE(status.message().find("the pairs of one instance need"), std::string::npos)
            << status.text();
        EXPECT_NE(status.message().find("of which shaders reach 1048576"), std::string::npos)
            << status.text();
        EXPECT_EQ(table->size(), 0U);
    }
}

TEST_F(DivisionOfPairs, AreTimedTogether) {
    Settings settings;
    settings.timestamps = true;
    ASSERT_NO_FATAL_FAILURE(make_small(little_memory, settings));
    make_crowd(device_pair_parts_seed + 8, 200, 2.0);
    PairTable<PenetrationQuery> table({.tolerance = 0.02}, on_device);
    ASSERT_TRUE(small_world().update(table).ok());
    EXPECT_EQ(table.timings().passes.size(), 12U);
    for (const PassTime& pass : table.timings().passes) {
        EXPECT_GE(pass.milliseconds, 0.0) << pass.name;
    }
}

}  // namespace
}  // namespace nearfield::test
