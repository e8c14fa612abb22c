#include <nearfield/device_poses.hpp>
#include <nearfield/world_pairs.hpp>

#include <gtest/gtest.h>
#include <shaders/pairs.h>
#include <tests/driver/device_world.hpp>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace nearfield::test {
namespace {

using Step = DeviceWorld::Step;

/// More than there is room for at first.
constexpr std::uint32_t pairs_found = 20'000;
constexpr std::uint32_t word_of_pairs = shaders::pair_total;

/// How a table is brought up to date.
/// Where shaders find what they count.
constexpr std::uint32_t pairs_binding = 3;

enum class Way {
    at_once,
    by_halves,  ///< submitted, and then collected
    on_device,  ///< at once, at poses in a buffer of the host's; results stay there too
    recorded,   ///< likewise, into a command buffer of the host, which submits it; results and
                ///< their headers go to buffers of the host
    in_parts,   ///< at once, on a device whose shaders do not reach the memory for all pairs
};

/// A table of pairs that the device finds; in the first step there is not room for all of them.
class PairsOfDevice : public DeviceWorld {
public:
    explicit PairsOfDevice(Way way)
        : DeviceWorld(way == Way::in_parts ? 1U << 21U : 1U << 30U),
          way_(way),
          table_(PenetrationQuery{.tolerance = 0.05, .on_device = are_resident()},
                 nearfield::test::on_device) {
        driver().let_shaders_find({pairs_binding, pairs_found, word_of_pairs, true});
        poses_.buffer = driver().make_buffer();
        poses_.size = 1U << 20U;
        poses_.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        for (BufferTarget* const target : {&target_.pairs, &target_.points}) {
            *target = {
                .buffer = driver().make_buffer(1024 + (1U << 19U)),
                .offset = 1024,
                .size = 1U << 19U,
                .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                .header_offset = 4};
        }
    }

    [[nodiscard]] Status submit() override { return world().submit(table_); }
    [[nodiscard]] Status ask() override {
        if (way_ == Way::at_once || way_ == Way::in_parts) {
            return world().update(table_);
        }
        if (way_ == Way::on_device) {
            return world().update(table_, at_poses(poses_));
        }
        if (way_ == Way::recorded) {
            Status status = record();
            return status.code() == StatusCode::overflow ? record() : status;
        }
        Status status = submit();
        return status.ok() ? table_.collect() : status;
    }

    void expect_nothing() const override {
        EXPECT_EQ(table_.size(), 0U);
        EXPECT_EQ(table_.candidates(), 0U);
        EXPECT_EQ(table_.left_to_cpu(), 0U);
    }
    void expect_to_work() override {
        DeviceWorld::expect_to_work();
        EXPECT_EQ(table_.candidates(), pairs_found);
        const Expected<PairsOnDevice> resident = table_.on_device();
        ASSERT_EQ(resident.has_value(), are_resident());
        if (!are_resident()) {
            return;
        }
        EXPECT_EQ(resident->pairs.buffer == target_.pairs.buffer, way_ == Way::recorded);
        EXPECT_EQ(resident->points.header.offset == 4, way_ == Way::recorded);
        for (const ArrayOnDevice& array : {resident->pairs, resident->points}) {
            EXPECT_TRUE(driver().has_memory(array.buffer, array.offset, array.size));
            EXPECT_TRUE(
                driver().has_memory(array.header.buffer, array.header.offset, sizeof(HeaderData)));
        }
    }

private:
    [[nodiscard]] bool are_resident() const {
        return way_ == Way::on_device || way_ == Way::recorded;
    }
    void enlarge() override { add(100, 5000); }
    void forget() override { table_ = PairTable(PenetrationQuery{}, on_device); }
    /// A frame of the host.
    Status record() {
        const VkCommandBuffer commands = driver().begin_commands();
        Status status = world().record(table_, {.commands = commands, .frame = ++frame_},
                                       {.poses = &poses_, .target = &target_});
        if (!status.ok()) {
            return status;
        }
        driver().submit(commands);
        driver().finish_submissions();
        life().context().frame_completed(frame_);
        return table_.collect();
    }

    Way way_;
    PairTable<PenetrationQuery> table_;
    DevicePoses poses_;
    PairTarget target_;
    std::uint64_t frame_ = 1000;  // others are before
};

class DevicePairsOfDriver : public ::testing::TestWithParam<Way> {
protected:
    static std::unique_ptr<DeviceWorld> make() {
        return std::make_unique<PairsOfDevice>(GetParam());
    }
};

TEST_P(DevicePairsOfDriver, NameFailingCallsLeakNothingAndWorkAfterwards) {
    expect_to_survive_failing_calls(make, [](Step step, auto& count) {
        // What was submitted with more room takes no poses of the host, so that is recorded anew.
        const std::uint32_t anew = GetParam() == Way::on_device ? 1 : 0;
        const std::uint32_t own = GetParam() == Way::recorded ? 0 : 1;
        EXPECT_EQ(count["vkQueueSubmit"], own * (step == Step::first ? 2 : 1));
        EXPECT_EQ(count["vkBeginCommandBuffer"], own * (step == Step::first   ? 2
                                                        : step == Step::moved ? anew
                                                                              : 1));
        EXPECT_EQ(count["vkCreateBuffer"] > 0, step != Step::moved);
    });
}

TEST_P(DevicePairsOfDriver, SayThatHostMemoryRunsOutAndWorkAfterwards) {
    expect_to_survive_scarce_memory(make);
}

INSTANTIATE_TEST_SUITE_P(Ways, DevicePairsOfDriver,
                         ::testing::Values(Way::at_once, Way::by_halves, Way::on_device,
                                           Way::recorded, Way::in_parts));

/// The second search, which has room for all, has two; the first one has one.
TEST(DevicePairsOfLittleReach, HaveTwoParts) {
    const auto dispatches = [](Way way) {
        PairsOfDevice pairs(way);
        pairs.driver().forget_calls();
        pairs.expect_to_work();
        const std::vector<std::string_view> calls = pairs.driver().calls();
        pairs.expect_to_leave_nothing();
        return std::count(calls.begin(), calls.end(), "vkCmdDispatchIndirect");
    };
    EXPECT_GT(dispatches(Way::at_once), 0);
    EXPECT_EQ(2 * dispatches(Way::in_parts), 3 * dispatches(Way::at_once));
}

/// As nothing of the context, a table that is still on the device leaves nothing.
TEST(DevicePairsInFlight, AreWaitedForByTheirDestructor) {
    PairsOfDevice pairs(Way::by_halves);
    EXPECT_TRUE(pairs.submit().ok());
    pairs.expect_to_leave_nothing();
}

}  // namespace
}  // namespace nearfield::test
