#include <tests/query/device_poses.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/watched_loader.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

struct RecordingCounts {
    std::uint64_t allocations_below = 0;  ///< those of the driver
    int objects = 0;                      ///< made or destroyed
    int waits = 0;
    int submissions = 0;
};
RecordingCounts counted_recording;  // entry points have no user data

void count_recorded_call(const test_support::WatchedCall& call) {
    counted_recording.allocations_below += call.allocations;
    counted_recording.objects += call.makes() || call.destroys() ? 1 : 0;
    counted_recording.waits += call.name.starts_with("vkWait") ? 1 : 0;
    counted_recording.submissions += call.name == "vkQueueSubmit" ? 1 : 0;
}

/// What it costs to record a table of pairs frame by frame.
class DevicePairRecordingCosts : public DevicePosesTest {
protected:
    void SetUp() override {
        DevicePosesTest::SetUp();
        loader_.emplace(host_device(), test_support::watched(host_device(), count_recorded_call));
        Settings settings;
        settings.pipelines_on_demand = true;
        Expected<Context> made = Context::create(loader_->host(), settings);
        ASSERT_TRUE(made.has_value()) << made.error().text();
        watched_.emplace(std::move(*made));
        world_.emplace(std::move(*World::create(*watched_)));
        Random random(30000);
        const ShapeHandle shape = *watched_->add_shape(coast(random, 100, 0.5));
        for (int i = 0; i < 20; ++i) {
            added_.push_back(*world_->add({.shape = shape, .pose = {{0.4 * i, 0.0}, 0.3 * i}}));
        }
    }
    void TearDown() override {
        world_.reset();
        watched_.reset();
        loader_.reset();
        DevicePosesTest::TearDown();
    }

    /// Records and collects frames, of which the first ones make what the others use.
    template <class Record>
    void expect_nothing_made(PairTableBase& table, const Record& record) {
        test_support::HostFrames host(host_device(), 1);
        ASSERT_TRUE(world_->update(table).ok());  // makes room
        for (std::uint64_t frame = first_frame_; frame < first_frame_ + 100; ++frame) {
            for (const InstanceHandle instance : added_) {
                const double angle = 0.7 * static_cast<double>(frame % 8);
                ASSERT_TRUE(
                    world_->move(instance, {{0.4 * instance.index, 0.0}, angle + instance.index})
                        .ok());
            }
            const VkCommandBuffer commands = host.begin(frame);
            expect_free(frame >= first_frame_ + 20, [&] {
                return record(Recording{.commands = commands, .frame = frame}).ok();
            });
            host.submit(frame);
            host.wait(frame);
            expect_free(frame >= first_frame_ + 20, [&] {
                watched_->frame_completed(frame);
                return world_->is_recorded(table) && table.is_ready() && table.collect().ok();
            });
            EXPECT_GT(table.size(), 0U);
        }
        first_frame_ += 100;
    }
    template <class Call>
    static void expect_free(bool is_warm, const Call& call) {
        counted_recording = {};
        const std::uint64_t before = test_support::allocation_count_of_this_thread();
        const bool ok = call();
        const std::uint64_t own = test_support::allocation_count_of_this_thread() - before;
        ASSERT_TRUE(ok);
        EXPECT_EQ(counted_recording.waits + counted_recording.submissions, 0);
        if (is_warm) {
            EXPECT_EQ(own, counted_recording.allocations_below);
            EXPECT_EQ(counted_recording.objects, 0);
        }
    }

    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> watched_;
    std::optional<World> world_;
    std::uint64_t first_frame_ = 0;
};

TEST_F(DevicePairRecordingCosts, AreNoAllocationNoObjectNoWaitAndNoSubmission) {
    const ContactQuery query{.tolerance = 0.05, .contact_distance = 0.05, .on_device = true};
    PairTable table(query, on_device);
    expect_nothing_made(
        table, [&](const Recording& recording) { return world_->record(table, recording); });
    PoseBuffer buffer = make_buffer();
    std::vector<HostPose> poses;
    for (int i = 0; i < 20; ++i) {
        poses.push_back({0.4F * static_cast<float>(i), 0.0F, 0.6F, 0.8F});
    }
    buffer.write(poses);
    gpu().finish();
    PairTable of_host(query, on_device);
    expect_nothing_made(of_host, [&](const Recording& recording) {
        return world_->record(of_host, recording, at_poses(buffer.poses()));
    });
}

}  // namespace
}  // namespace nearfield::test
