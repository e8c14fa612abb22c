#include <engine/base/status_exception.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu/compute_task.hpp>
#include <tests/unit/gpu/fixture.hpp>

#include <cstring>

namespace nearfield {
namespace {

using test_support::FakeLoader;
using test_support::Lies;

class GpuSubmission : public test_support::GpuTest {};
class GpuTimestamps : public test_support::GpuTest {};

TEST_F(GpuSubmission, WaitingBeforeTheFirstSubmissionReturns) {
    const gpu::Device device(host_.device());
    gpu::Submission submission(device);
    submission.wait();
}

TEST_F(GpuSubmission, IsUsedOverAndOver) {
    const gpu::Device device(host_.device());
    gpu::Submission submission(device);
    for (int round = 0; round < 20; ++round) {
        VkCommandBuffer commands = submission.begin();
        ASSERT_NE(commands, VkCommandBuffer{VK_NULL_HANDLE});
        device.begin_label(commands, "nothing");
        device.end_label(commands);
        submission.submit();
        while (!submission.is_done()) {
        }
        submission.wait();
        submission.wait();
        EXPECT_TRUE(submission.is_done());
    }
}

// The value that a timeline semaphore is said to have reached.
std::uint64_t reached_value = 0;
VkResult VKAPI_CALL said_value(VkDevice, VkSemaphore, std::uint64_t* value) {
    *value = reached_value;
    return VK_SUCCESS;
}

TEST_F(GpuSubmission, ByTimelineIsDoneWhenItsValueIsReachedAndNoSooner) {
    test_support::VulkanHost host({.timeline_semaphore = true});
    Lies lies;
    for (const char* name : {"vkGetSemaphoreCounterValue", "vkGetSemaphoreCounterValueKHR"}) {
        lies.entry_points[name] = reinterpret_cast<PFN_vkVoidFunction>(&said_value);
    }
    {
        HostDevice truth = host.device();
        ASSERT_TRUE(truth.timeline_semaphore) << "the driver has no timeline semaphores";
        truth.completion_by_timeline = true;
        const FakeLoader fake(truth, lies);
        const gpu::Device device(fake.host());
        gpu::Submission submission(device);
        for (std::uint64_t round = 1; round <= 3; ++round) {
            (void)submission.begin();
            submission.submit();
            submission.wait();
            for (std::uint64_t value = 0; value <= round + 1; ++value) {
                reached_value = value;
                EXPECT_EQ(submission.is_done(), value >= round) << value << " of " << round;
            }
        }
    }
    EXPECT_EQ(host.close(), std::vector<std::string>{});
}

// Times `passes`, one dispatch each, in one submission.
void time_passes(const gpu::Device& device, gpu::Timestamps& timestamps,
                 const std::vector<const char*>& passes) {
    constexpr std::uint32_t count = 100'000;
    gpu::MappedBuffer source(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
                             "source");
    gpu::MappedBuffer target(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
                             "target");
    source.reserve(count * sizeof(std::uint32_t));
    target.reserve(count * sizeof(std::uint32_t));
    std::memset(source.data(), 0, source.capacity());
    source.flush();
    test_support::ComputeTask task(device);
    task.bind(source, target);
    gpu::Submission submission(device);
    VkCommandBuffer commands = submission.begin();
    timestamps.reset(commands);
    for (const char* pass : passes) {
        timestamps.begin(commands, pass);
        task.record(commands, count);
        timestamps.end(commands);
    }
    submission.submit();
    submission.wait();
}

TEST_F(GpuTimestamps, EveryPassTakesTimeAndPassesOfOneNameAreAdded) {
    const gpu::Device device(host_.device());
    ASSERT_GT(device.timestamp_bits(), 0U);
    gpu::Timestamps timestamps(device, 3);
    std::vector<PassTime> times;
    for (int round = 1; round <= 2; ++round) {
        const std::vector<PassTime> former = times;
        time_passes(device, timestamps, {"fill", "resolve", "fill"});
        timestamps.collect(times);
        ASSERT_EQ(times.size(), 2U);
        EXPECT_EQ(times[0].name, "fill");
        EXPECT_EQ(times[1].name, "resolve");
        for (std::size_t i = 0; i < times.size(); ++i) {
            EXPECT_GT(times[i].milliseconds, former.empty() ? 0.0 : former[i].milliseconds);
            EXPECT_LT(times[i].milliseconds, 60'000.0);
        }
    }
}

TEST_F(GpuTimestamps, MorePassesThanThereIsRoomForAreRefused) {
    const gpu::Device device(host_.device());
    gpu::Timestamps timestamps(device, 1);
    EXPECT_THROW(time_passes(device, timestamps, {"one", "two"}), StatusException);
}

TEST_F(GpuTimestamps, RoomCanBeMadeForMorePasses) {
    const gpu::Device device(host_.device());
    gpu::Timestamps timestamps(device, 1);
    timestamps.reserve(2);
    timestamps.reserve(1);
    time_passes(device, timestamps, {"one", "two"});
    std::vector<PassTime> times;
    timestamps.collect(times);
    EXPECT_EQ(times.size(), 2U);
}

TEST_F(GpuTimestamps, NothingIsMeasuredWhereTheQueueHasNone) {
    Lies lies;
    lies.queue_families = [](std::vector<VkQueueFamilyProperties>& families) {
        for (VkQueueFamilyProperties& family : families) {
            family.timestampValidBits = 0;
        }
    };
    const FakeLoader fake(host_.device(), lies);
    const gpu::Device device(fake.host());
    gpu::Timestamps timestamps(device, 1);
    time_passes(device, timestamps, {"one", "two"});
    std::vector<PassTime> times;
    timestamps.collect(times);
    EXPECT_TRUE(times.empty());
}

// A counter of 36 bits that wraps between the two timestamps, with garbage above the valid bits.
VkResult VKAPI_CALL wrapping_results(VkDevice, VkQueryPool, std::uint32_t, std::uint32_t,
                                     std::size_t, void* data, VkDeviceSize, VkQueryResultFlags) {
    const std::uint64_t ticks[2]{(std::uint64_t{1} << 36U) - 1000, (std::uint64_t{5} << 40U) + 500};
    std::memcpy(data, ticks, sizeof(ticks));
    return VK_SUCCESS;
}

VkResult VKAPI_CALL unready_results(VkDevice, VkQueryPool, std::uint32_t, std::uint32_t,
                                    std::size_t, void*, VkDeviceSize, VkQueryResultFlags) {
    return VK_NOT_READY;
}

TEST_F(GpuTimestamps, CounterMayWrapAndTicksAreScaled) {
    Lies lies;
    lies.queue_families = [](std::vector<VkQueueFamilyProperties>& families) {
        for (VkQueueFamilyProperties& family : families) {
            family.timestampValidBits = 36;
        }
    };
    lies.properties = [](VkPhysicalDeviceProperties& properties) {
        properties.limits.timestampPeriod = 40.0F;
    };
    lies.entry_points["vkGetQueryPoolResults"] =
        reinterpret_cast<PFN_vkVoidFunction>(&wrapping_results);
    const FakeLoader fake(host_.device(), lies);
    const gpu::Device device(fake.host());
    gpu::Timestamps timestamps(device, 1);
    time_passes(device, timestamps, {"pass"});
    std::vector<PassTime> times;
    timestamps.collect(times);
    ASSERT_EQ(times.size(), 1U);
    EXPECT_NEAR(times[0].milliseconds, 1500 * 40e-6, 1e-12);
}

TEST_F(GpuTimestamps, UnwrittenTimestampsLeaveNoTimesAndNoError) {
    Lies lies;
    lies.entry_points["vkGetQueryPoolResults"] =
        reinterpret_cast<PFN_vkVoidFunction>(&unready_results);
    const FakeLoader fake(host_.device(), lies);
    const gpu::Device device(fake.host());
    gpu::Timestamps timestamps(device, 1);
    time_passes(device, timestamps, {"pass"});
    std::vector<PassTime> times;
    EXPECT_NO_THROW(timestamps.collect(times));
    EXPECT_TRUE(times.empty());
}

}  // namespace
}  // namespace nearfield
