#include <tests/query/host_table.hpp>

#include <array>

namespace nearfield::test {
namespace {

using test_support::Enabled;
using test_support::HostFrames;
using test_support::WatchedCall;

TEST_F(HostTable, Work) {
    make_host();
    int submissions = 0;
    Context context = make(watch(
        [&](const WatchedCall& call) { submissions += call.name == "vkQueueSubmit" ? 1 : 0; }));
    const Scene scene(context);
    HostFrames frames(host(), 2);
    const Batch batch = scene.every(true);
    const std::vector<double> submitted = scene.collect(context.submit(batch));
    EXPECT_EQ(submissions, 1);
    EXPECT_EQ(scene.record(batch, frames, 0), submitted);
    EXPECT_EQ(submissions, 1);
}

VkSemaphore make_semaphore(const HostDevice& host, bool timeline) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = timeline ? &type : nullptr;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    EXPECT_EQ(test_support::host_function<PFN_vkCreateSemaphore>(host, "vkCreateSemaphore")(
                  host.device, &info, nullptr, &semaphore),
              VK_SUCCESS);
    return semaphore;
}

void destroy_semaphore(const HostDevice& host, VkSemaphore semaphore) {
    test_support::host_function<PFN_vkDestroySemaphore>(host, "vkDestroySemaphore")(
        host.device, semaphore, nullptr);
}

TEST_F(HostTable, HandOff) {
    Enabled enabled;
    enabled.timeline_semaphore = true;
    make_host(enabled);
    VkSemaphore const timeline = make_semaphore(host(), true);
    VkSemaphore const binary = make_semaphore(host(), false);
    const auto counter = [&] {
        std::uint64_t value = 0;
        EXPECT_EQ(test_support::host_function<PFN_vkGetSemaphoreCounterValueKHR>(
                      host(), "vkGetSemaphoreCounterValueKHR")(host().device, timeline, &value),
                  VK_SUCCESS);
        return value;
    };
    const auto signal = [&](std::uint64_t value) {
        VkSemaphoreSignalInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
        info.semaphore = timeline;
        info.value = value;
        EXPECT_EQ(test_support::host_function<PFN_vkSignalSemaphoreKHR>(
                      host(), "vkSignalSemaphoreKHR")(host().device, &info),
                  VK_SUCCESS);
    };
    const auto wait_for = [&](std::uint64_t value) {
        VkSemaphoreWaitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
        info.semaphoreCount = 1;
        info.pSemaphores = &timeline;
        info.pValues = &value;
        EXPECT_EQ(test_support::host_function<PFN_vkWaitSemaphoresKHR>(
                      host(), "vkWaitSemaphoresKHR")(host().device, &info, UINT64_MAX),
                  VK_SUCCESS);
    };
    {
        Context context = make(host());
        const Scene scene(context);
        const std::vector<double> expected = scene.run(scene.small());
        // One waits for the host, the other for the first by the binary semaphore.
        const SemaphoreWait for_host{timeline, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 1};
        const std::array<SemaphoreSignal, 2> both{{{timeline, 2}, {binary, 0}}};
        const SemaphoreWait for_first{binary};
        const SemaphoreSignal last{timeline, 3};
        // Whether the device has anything to do or not.
        for (const bool device_works : {true, false}) {
            SCOPED_TRACE(device_works);
            const std::uint64_t base = counter();
            const auto later = [&](auto semaphore) {
                semaphore.value += semaphore.value == 0 ? 0 : base;
                return semaphore;
            };
            const std::array<SemaphoreSignal, 2> signals{later(both[0]), later(both[1])};
            const SemaphoreWait wait = later(for_host);
            const SemaphoreSignal end = later(last);
            const Batch batch = device_works ? scene.small() : scene.on_cpu();
            const Expected<Ticket> first =
                context.submit(batch, {.waits = {&wait, 1}, .signals = signals});
            ASSERT_TRUE(first.ok()) << first.status().text();
            EXPECT_EQ(context.is_ready(*first), !device_works);
            EXPECT_EQ(counter(), base);
            signal(base + 1);
            const Expected<Ticket> second =
                context.submit(batch, {.waits = {&for_first, 1}, .signals = {&end, 1}});
            ASSERT_TRUE(second.ok()) << second.status().text();
            wait_for(base + 3);
            const std::vector<double> numbers = scene.collect(first);
            EXPECT_EQ(scene.collect(second), numbers);
            EXPECT_EQ(device_works ? numbers : expected, expected);
        }
        // What cannot be used is said by name, and nothing is submitted.
        const std::uint64_t before = counter();
        const auto refusal = [&](const Submission& submission) {
            const Status status = context.submit(scene.small(), submission).status();
            EXPECT_EQ(status.code(), StatusCode::invalid_submission) << status.text();
            return status.message();
        };
        const SemaphoreWait null_wait{};
        const SemaphoreWait no_stage{binary, 0};
        const SemaphoreSignal null_signal{};
        EXPECT_NE(refusal({.waits = {&null_wait, 1}}).find("waits[0].semaphore"),
                  std::string::npos);
        EXPECT_NE(refusal({.waits = {&no_stage, 1}}).find("waits[0].stages"), std::string::npos);
        EXPECT_NE(refusal({.signals = {&null_signal, 1}}).find("signals[0].semaphore"),
                  std::string::npos);
        EXPECT_EQ(counter(), before);
    }
    destroy_semaphore(host(), timeline);
    destroy_semaphore(host(), binary);
}

TEST_F(HostTable, Waits) {
    make_host();
    std::set<std::string> names;
    {
        // Made, grown, lost sight of and destroyed, in both ways of working.
        Context context = make(noting_names(host(), names));
        const Scene scene(context);
        HostFrames frames(host(), 2);
        (void)scene.record(scene.small(), frames, 0);
        (void)scene.run(scene.small(0.002));
        const Expected<Ticket> ticket = context.submit(scene.small());
        EXPECT_TRUE(ticket.ok());
    }
    EXPECT_TRUE(names.contains("vkWaitForFences"));
    EXPECT_FALSE(names.contains("vkDeviceWaitIdle"));
    EXPECT_FALSE(names.contains("vkQueueWaitIdle"));
    // Each of its own submissions is waited for once, and nothing of what is recorded.
    int waits = 0;
    {
        Context context =
            make(watch([&](const WatchedCall& call) { waits += call.name == "vkWaitForFences"; }));
        EXPECT_EQ(waits, 0);
        const Scene scene(context);
        HostFrames frames(host(), 2);
        (void)scene.record(scene.every(true), frames, 0);
        (void)scene.record(scene.small(0.002), frames, 1);
        EXPECT_EQ(waits, 0);
        (void)scene.run(scene.small());
        EXPECT_EQ(waits, 1);
        const Expected<Ticket> recorded =
            context.record(scene.small(), {.commands = frames.begin(2), .frame = 2});
        EXPECT_TRUE(recorded.ok());
        frames.abandon(2);
    }
    EXPECT_EQ(waits, 1);
}

TEST_F(HostTable, Lifetime) {
    make_host();
    for (std::uint32_t in_flight = 1; in_flight <= most_frames_in_flight; ++in_flight) {
        SCOPED_TRACE(in_flight);
        Context context = make(host(), in_flight);
        const Scene scene(context);
        HostFrames frames(host(), in_flight);
        // Each needs a larger atlas than the one before, which is still in flight.
        std::vector<Expected<Ticket>> tickets;
        std::vector<Batch> batches;
        for (std::uint32_t frame = 0; frame < in_flight; ++frame) {
            batches.push_back(scene.small(0.2 / (1U << frame)));
            tickets.push_back(
                context.record(batches.back(), {.commands = frames.begin(frame), .frame = frame}));
            frames.submit(frame);
        }
        EXPECT_EQ(
            context
                .record(batches[0], {.commands = frames.begin(in_flight), .frame = in_flight - 1})
                .status()
                .code(),
            StatusCode::ring_full);
        frames.abandon(in_flight);
        frames.wait(in_flight - 1);
        context.frame_completed(in_flight - 1);
        std::vector<std::vector<double>> answers;
        for (const Expected<Ticket>& ticket : tickets) {
            answers.push_back(scene.collect(ticket));
        }
        for (std::uint32_t frame = 0; frame < in_flight; ++frame) {
            EXPECT_EQ(answers[frame], scene.run(batches[frame])) << "frame " << frame;
        }
    }
}

}  // namespace
}  // namespace nearfield::test
