#include <engine/base/status_exception.hpp>

#include <tests/unit/render/searched.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::render {
namespace {

using device_input::PairGoal;
using device_input::PairQuestion;

constexpr std::uint64_t everything = std::uint64_t{1} << 40U;
constexpr PairLimits no_limits{everything, everything};
constexpr PairQuestion penetrations{.goal = PairGoal::penetrations, .records = true};

/// So many pairs, and of the other stages what goes with them.
PairCounts counts_of(std::uint32_t pairs) {
    return {10 * pairs, 30 * pairs, 30 * pairs, pairs, 3 * pairs, pairs / 2};
}

Searched even_world(std::uint32_t instances, std::uint32_t pairs,
                    const PairQuestion& question = penetrations) {
    return {question, std::vector<PairCounts>(instances, counts_of(pairs))};
}

/// Why a world cannot be searched.
std::string refusal(const Searched& world, PairParts& parts, const PairLimits& limits) {
    try {
        world.search(parts, limits);
    } catch (const StatusException& error) {
        EXPECT_EQ(error.status().code(), StatusCode::too_large);
        return error.status().message();
    }
    return {};
}

TEST(PairParts, HaveNothingToSpareIfThereIsNoMemoryForIt) {
    const Searched world = even_world(1000, 40);
    const PairCounts all = world.counts(0, 1000);
    PairParts parts = parts_of(penetrations);
    world.search(parts, no_limits);
    const PairBytes bytes = world.bytes(all);
    const std::uint64_t memory = bytes.scratch + bytes.found();
    world.search(parts, {everything, memory + memory / 7});
    ASSERT_EQ(parts.count(), 1U);
    EXPECT_EQ(parts[0].capacities[shaders::edge_total], all[shaders::edge_total] * 9 / 8)
        << "an eighth is to spare";

    Searched one = even_world(1, 4000);
    PairParts of_one = parts_of(penetrations);
    one.search(of_one, no_limits);
    const std::uint64_t exactly = one.bytes(one.counts(0, 1)).largest();
    EXPECT_EQ(one.search(of_one, {exactly, everything}), 1);
    EXPECT_EQ(of_one[0].capacities, one.counts(0, 1));
    EXPECT_NE(refusal(one, of_one, {exactly - 1, everything}), "");
}

TEST(PairParts, SayWhatIsTooLarge) {
    const Searched world = even_world(3, 4000);
    const PairBytes bytes = world.bytes(counts_of(4000));
    const std::uint64_t reach = bytes.largest() - 1;
    PairParts parts = parts_of(penetrations);
    EXPECT_EQ(refusal(world, parts, {reach, everything}),
              "the pairs of one instance need " + std::to_string(reach + 1) +
                  " bytes on the device in one buffer, of which shaders reach " +
                  std::to_string(reach));
}

TEST(PairParts, SayThatAllOfThemAreTooLarge) {
    const Searched world = even_world(1, 4000);
    const PairBytes bytes = world.bytes(world.counts(0, 1));
    const std::uint64_t all = bytes.scratch + bytes.found();
    PairParts parts = parts_of(penetrations);
    world.search(parts, no_limits);
    EXPECT_EQ(refusal(world, parts, {everything, all}), "");
    EXPECT_EQ(refusal(world, parts, {everything, all - 1}),
              "the pairs of the world need " + std::to_string(all) +
                  " bytes on the device; Settings::memory_limit is " + std::to_string(all - 1));
}

TEST(PairParts, SayWhatThatStaysIsTooLarge) {
    PairQuestion question = penetrations;
    question.on_device = true;
    const Searched world = even_world(1000, 40, question);
    const std::uint64_t records = world.resident_bytes(world.counts(0, 1000)).records;
    PairParts parts = parts_of(question);
    world.search(parts, no_limits);
    const std::uint64_t reach = records - 1;
    EXPECT_EQ(refusal(world, parts, {reach, everything}),
              "the pairs that stay need " + std::to_string(records) +
                  " bytes on the device in one buffer, of which shaders reach " +
                  std::to_string(reach));
}

/// What is known of given pairs before anything is counted.
PairCounts given(std::uint32_t pairs) {
    PairCounts counts{};
    counts[shaders::pair_total] = pairs;
    counts[shaders::item_total] = 3 * pairs;
    return counts;
}

TEST(PairParts, OfGivenPairsHaveTheRoomThatIsAskedFor) {
    PairParts parts(device_input::given_pairs, first_capacities(device_input::given_pairs, {}),
                    false);
    const PairCounts room = counts_of(20000);
    EXPECT_TRUE(parts.set_given(given(20000), room));
    parts.fit(no_limits);
    ASSERT_EQ(parts.count(), 1U);
    EXPECT_EQ(parts[0].end, 20000U);
    EXPECT_TRUE(is_within(room, parts[0].capacities));
    EXPECT_TRUE(is_within(given(20000), parts[0].capacities));
    EXPECT_FALSE(parts.set_given(given(20000), room)) << "they are the same";
    EXPECT_TRUE(parts.set_given(given(10000), room)) << "there are fewer";
    EXPECT_EQ(parts[0].end, 10000U);
}

TEST(PairParts, OfGivenPairsAreDividedAndBecomeOneAgain) {
    PairParts parts(device_input::given_pairs, first_capacities(device_input::given_pairs, {}),
                    false);
    const std::uint32_t pairs = 20000;
    shaders::SearchPush push{};
    const std::uint64_t all =
        place_pair_arrays(device_input::given_pairs, 0, counts_of(pairs), push).largest();
    const PairLimits limits{all / 3, everything};
    parts.set_given(given(pairs), counts_of(pairs));
    for (bool had_room = false; !had_room;) {
        parts.fit(limits);
        had_room = true;
        for (std::size_t i = 0; i < parts.count(); ++i) {
            const PairCounts own = counts_of(parts[i].end - parts[i].first);
            if (is_within(own, parts[i].capacities)) {
                parts.note(i, own);
            } else {
                parts.grow(i, own, 1.0);
                had_room = false;
            }
        }
    }
    EXPECT_GE(parts.count(), 3U);
    EXPECT_EQ(parts[parts.count() - 1].end, pairs);
    EXPECT_FALSE(parts.set_given(given(pairs), counts_of(pairs))) << "as many as before";
    EXPECT_TRUE(parts.set_given(given(100), counts_of(100)));
    parts.fit(limits);
    ASSERT_EQ(parts.count(), 1U);
    EXPECT_EQ(parts[0].end, 100U);
}

}  // namespace
}  // namespace nearfield::render
