#include <tests/query/device_pairs.hpp>
#include <tests/query/steady_state.hpp>
#include <tests/support/host_frames.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostFrames;

constexpr ContactQuery room_contacts{.tolerance = 0.05, .contact_distance = 0.05};

/// Room for what recorded tables find: before, while and after there is more of it.
class RoomOfTables : public SteadyStateTest {
protected:
    static constexpr std::uint64_t frames = 3;

    void SetUp() override {
        SteadyStateTest::SetUp();
        world_.emplace(watched());
        Random random(7100);
        shape_ = *watched().add_shape(star(random, 12, 0.6));
    }
    void TearDown() override {
        world_.reset();
        SteadyStateTest::TearDown();
    }

    void add(int count) {
        for (; count > 0; --count) {
            const auto handle = world_->add({.shape = shape_});
            ASSERT_TRUE(handle.has_value()) << handle.error().text();
            instances_.push_back(*handle);
        }
    }
    /// Puts the instances on a square grid of this spacing.
    void spread(double spacing, Random& random) {
        const auto side =
            static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(instances_.size()))));
        for (std::size_t i = 0; i < instances_.size(); ++i) {
            const Pose pose{
                {spacing * static_cast<double>(i % side), spacing * static_cast<double>(i / side)},
                random.between(0.0, 6.0)};
            ASSERT_TRUE(world_->move(instances_[i], pose).ok());
        }
    }
    [[nodiscard]] static PairTable<ContactQuery> make_table(PairTableOptions options) {
        options.hits_only = true;
        options.technique = Technique::compute;
        return PairTable<ContactQuery>(room_contacts, options);
    }
    /// Of one search that is recorded and executed.
    [[nodiscard]] Status search(PairTable<ContactQuery>& table, HostFrames& host) {
        const std::uint64_t frame = frame_++;
        const VkCommandBuffer commands = host.begin(frame);
        const Status status = world_->record(table, {.commands = commands, .frame = frame});
        EXPECT_TRUE(status.ok()) << status.text();
        host.submit(frame);
        host.wait(frame);
        watched().frame_completed(frame);
        return table.collect();
    }

    std::optional<World> world_;
    ShapeHandle shape_;
    std::vector<InstanceHandle> instances_;
    std::uint64_t frame_ = 0;
};

TEST_F(RoomOfTables, IsReservedBeforeAnythingIsFound) {
    Random random(7101);
    add(1200);
    spread(0.9, random);
    HostFrames host(host_device(), 1);
    auto surprised = make_table({});
    const Status overflow = search(surprised, host);
    EXPECT_EQ(overflow.code(), StatusCode::overflow);
    const PairTableCounts found = surprised.found();
    EXPECT_TRUE(found.pairs > surprised.capacity().pairs ||
                found.edge_groups > surprised.capacity().edge_groups)
        << overflow.text();
    for (int i = 0; i < 5 && !search(surprised, host).ok(); ++i) {
    }
    const PairTableCounts needed = surprised.found();
    EXPECT_GT(needed.pairs, 5000U);
    EXPECT_EQ(needed.rows, surprised.size());
    auto prepared = make_table({.reserve = needed});
    const Status status = search(prepared, host);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(prepared.found(), needed);
    EXPECT_EQ(numbers_of_table(prepared), numbers_of_table(surprised));
}

TEST_F(RoomOfTables, IsGivenBackAfterASpike) {
    Random random(7102);
    add(600);
    HostFrames host(host_device(), 1);
    auto table = make_table({});
    spread(0.2, random);
    ASSERT_TRUE(world_->update(table).ok());
    const std::uint64_t most = watched().memory_use().in_use;
    spread(1.6, random);
    ASSERT_TRUE(world_->update(table).ok());
    const std::vector<double> numbers = numbers_of_table(table);
    EXPECT_EQ(watched().memory_use().in_use, most);
    table.trim();
    watched().trim();
    EXPECT_LT(watched().memory_use().in_use, most / 2);
    EXPECT_EQ(table.size(), 0U);
    EXPECT_FALSE(world_->is_recorded(table));
    const Status status = search(table, host);  // what was found before has room
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(numbers_of_table(table), numbers);
    EXPECT_LT(watched().memory_use().in_use, most);
}

TEST_F(RoomOfTables, IsNotGivenBackWhileTheDeviceMayUseIt) {
    Random random(7103);
    add(100);
    spread(0.9, random);
    HostFrames host(host_device(), 1);
    auto table = make_table({.reserve = {.pairs = 4096, .points = 16384}});
    ASSERT_TRUE(world_->record(table, {.commands = host.begin(0), .frame = 0}).ok());
    table.trim();
    EXPECT_TRUE(world_->is_recorded(table));
    host.submit(0);
    host.wait(0);
    EXPECT_GT(table.found().rows, 0U);
    watched().frame_completed(0);
    EXPECT_TRUE(table.collect().ok());
    EXPECT_EQ(table.found().rows, table.size());
}

/// Three frames in flight while the world grows, shrinks, deforms, gathers and scatters: what is
/// not flagged is complete, nothing waits, and there are no more flags than doublings.
/// NEARFIELD_TEST_CASES sets the number of frames.
TEST_F(RoomOfTables, GrowsInTheFramesOfAHostWithoutAWait) {
    const auto count = static_cast<std::uint64_t>(random_cases(240));
    Random random(7104);
    std::array<PairTable<ContactQuery>, frames> tables{make_table({}), make_table({}),
                                                       make_table({})};
    std::array<std::vector<double>, frames> expected;
    PairTable<ContactQuery> truth(room_contacts, {.hits_only = true, .technique = Technique::cpu});
    HostFrames host(host_device(), frames);
    add(60);
    std::uint32_t flagged = 0;
    std::uint32_t complete = 0;
    const auto collect = [&](std::uint64_t frame) {
        auto& table = tables[frame % frames];
        host.wait(frame);
        watched().frame_completed(frame);
        const Status status = table.collect();
        if (status.code() == StatusCode::overflow) {
            ++flagged;
            const PairTableCounts found = table.found();
            const PairTableCounts room = table.capacity();
            EXPECT_TRUE(found.pairs > room.pairs || found.points > room.points ||
                        found.rows > room.rows || found.edge_groups > room.edge_groups ||
                        found.edges > room.edges || found.tested_points > room.tested_points)
                << status.text();
            return;
        }
        ASSERT_TRUE(status.ok()) << status.text();
        ++complete;
        const std::vector<double>& all = expected[frame % frames];
        ASSERT_EQ(table.size(), all.size()) << "frame " << frame;
        const auto rows = table.rows();
        ASSERT_EQ(rows.size(), all.size()) << table.read_status().text();
        for (const PairRow<ContactQuery>& row : rows) {
            ASSERT_EQ(row.count, all[row.index]) << "frame " << frame << ", row " << row.index;
        }
    };
    for (std::uint64_t frame = 0; frame < count; ++frame) {
        if (frame >= frames) {
            collect(frame - frames);
        }
        if (frame % 20 == 10) {
            add(random.whole(0, 60));
        }
        if (frame % 30 == 20) {
            for (int i = random.whole(0, instances_.size() > 300 ? 200 : 20); i > 0; --i) {
                ASSERT_TRUE(world_->remove(instances_.back()).ok());
                instances_.pop_back();
            }
        }
        if (frame % 7 == 3) {
            ASSERT_TRUE(
                watched().update_shape(shape_, star(random, random.whole(8, 20), 0.6)).ok());
        }
        const bool is_spike = frame % 61 == 45;  // of each table in turn
        spread(is_spike ? 0.3 : 0.9 + 0.3 * std::sin(0.1 * static_cast<double>(frame)), random);
        ASSERT_TRUE(world_->update(truth).ok());
        std::vector<double>& rows = expected[frame % frames];
        rows.clear();
        for (const auto& row : truth.rows()) {
            rows.push_back(row.count);
        }
        const VkCommandBuffer commands = host.begin(frame);
        waits_and_submissions = 0;
        const Status status =
            world_->record(tables[frame % frames], {.commands = commands, .frame = frame});
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(waits_and_submissions, 0);
        host.submit(frame);
    }
    for (std::uint64_t frame = count - frames; frame < count; ++frame) {
        collect(frame);
    }
    double doublings = 0.0;
    for (const auto& table : tables) {
        const PairTableCounts room = table.capacity();
        doublings += std::max({std::log2(room.pairs / 4096.0), std::log2(room.points / 4096.0),
                               std::log2(room.rows / 1024.0), std::log2(room.edges / 16384.0),
                               std::log2(room.edge_groups / 1024.0),
                               std::log2(room.tested_points / 16384.0)});
    }
    EXPECT_LE(flagged, doublings) << "of " << count << " frames";
    EXPECT_GT(flagged, 0U) << "nothing was tried";
    EXPECT_EQ(flagged + complete, count);
}

}  // namespace
}  // namespace nearfield::test
