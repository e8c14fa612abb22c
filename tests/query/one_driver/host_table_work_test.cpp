#include <tests/query/every_query.hpp>
#include <tests/query/host_table.hpp>

#include <array>
#include <type_traits>

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
    const Batch batch = scene.every();
    const std::vector<double> submitted = scene.collect(context.submit(batch));
    EXPECT_EQ(submissions, 1);
    EXPECT_EQ(scene.record(batch, frames, 0), submitted);
    EXPECT_EQ(submissions, 1);
}

/// However many queries, kinds and results: all descriptors of a batch are written by one call,
/// those of its search for points by another, and those of the points that stay on the device by a
/// third. What they refer to already is not written again.
TEST_F(HostTable, DescriptorsAreWrittenTogether) {
    make_host();
    int updates = 0;
    Context context = make(watch([&](const WatchedCall& call) {
        updates += call.name == "vkUpdateDescriptorSets" ? 1 : 0;
    }));
    const Scene scene(context);
    HostFrames frames(host(), 1);
    Batch all = scene.every();
    const Batch staying = resident_queries(all);
    for (const AnyQuery& query : staying.queries()) {
        std::visit([&](const auto& same) { all.add(same); }, query);
    }
    for (std::uint64_t frame = 0; frame < 4; ++frame) {
        updates = 0;
        (void)scene.record(frame % 2 == 0 ? all : scene.small(), frames, frame);
        constexpr std::array expected{3, 1, 0, 0};
        EXPECT_EQ(updates, expected[frame]) << frame;
    }
}

/// A semaphore of the host, destroyed with this object.
class HostSemaphore {
public:
    HostSemaphore(const HostDevice& host, VkSemaphoreType type) : host_(host) {
        VkSemaphoreTypeCreateInfo of_type{};
        of_type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
        of_type.semaphoreType = type;
        VkSemaphoreCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        info.pNext = type == VK_SEMAPHORE_TYPE_TIMELINE ? &of_type : nullptr;
        EXPECT_EQ(call<PFN_vkCreateSemaphore>("vkCreateSemaphore", &info, nullptr, &semaphore_),
                  VK_SUCCESS);
    }
    ~HostSemaphore() { call<PFN_vkDestroySemaphore>("vkDestroySemaphore", semaphore_, nullptr); }
    HostSemaphore(const HostSemaphore&) = delete;
    HostSemaphore& operator=(const HostSemaphore&) = delete;

    [[nodiscard]] VkSemaphore get() const { return semaphore_; }

    // For timeline semaphores.

    [[nodiscard]] std::uint64_t value() const {
        std::uint64_t value = 0;
        EXPECT_EQ(call<PFN_vkGetSemaphoreCounterValueKHR>("vkGetSemaphoreCounterValueKHR",
                                                          semaphore_, &value),
                  VK_SUCCESS);
        return value;
    }
    void signal(std::uint64_t value) const {
        VkSemaphoreSignalInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
        info.semaphore = semaphore_;
        info.value = value;
        EXPECT_EQ(call<PFN_vkSignalSemaphoreKHR>("vkSignalSemaphoreKHR", &info), VK_SUCCESS);
    }
    void wait_for(std::uint64_t value) const {
        VkSemaphoreWaitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
        info.semaphoreCount = 1;
        info.pSemaphores = &semaphore_;
        info.pValues = &value;
        EXPECT_EQ(call<PFN_vkWaitSemaphoresKHR>("vkWaitSemaphoresKHR", &info, UINT64_MAX),
                  VK_SUCCESS);
    }

private:
    template <class Function, class... Arguments>
    std::invoke_result_t<Function, VkDevice, Arguments...> call(const char* name,
                                                                Arguments... arguments) const {
        return test_support::host_function<Function>(host_, name)(host_.device, arguments...);
    }

    HostDevice host_;
    VkSemaphore semaphore_ = VK_NULL_HANDLE;
};

TEST_F(HostTable, HandOff) {
    Enabled enabled;
    enabled.timeline_semaphore = true;
    make_host(enabled);
    Context context = make(host());
    const Scene scene(context);
    if (!host().timeline_semaphore) {
        expect_timelines_refused(context, scene.small());
        return;
    }
    const HostSemaphore timeline(host(), VK_SEMAPHORE_TYPE_TIMELINE);
    const HostSemaphore binary(host(), VK_SEMAPHORE_TYPE_BINARY);
    const std::vector<double> expected = scene.run(scene.small());
    // With and without work for the device.
    for (const bool device_works : {true, false}) {
        SCOPED_TRACE(device_works);
        // One waits for the host, the other for the first through the binary semaphore.
        const std::uint64_t base = timeline.value();
        const SemaphoreWait for_host{timeline.get(), VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, base + 1};
        const std::array<SemaphoreSignal, 2> both{{{timeline.get(), base + 2}, {binary.get(), 0}}};
        const SemaphoreWait for_first{binary.get()};
        const SemaphoreSignal last{timeline.get(), base + 3};
        const Batch batch = device_works ? scene.small() : scene.on_cpu();
        const Expected<Ticket> first =
            context.submit(batch, {.waits = {&for_host, 1}, .signals = both});
        ASSERT_TRUE(first.has_value()) << first.error().text();
        EXPECT_EQ(context.is_ready(*first), !device_works);
        EXPECT_EQ(timeline.value(), base);
        timeline.signal(base + 1);
        const Expected<Ticket> second =
            context.submit(batch, {.waits = {&for_first, 1}, .signals = {&last, 1}});
        ASSERT_TRUE(second.has_value()) << second.error().text();
        timeline.wait_for(base + 3);
        const std::vector<double> numbers = scene.collect(first);
        EXPECT_EQ(scene.collect(second), numbers);
        EXPECT_EQ(device_works ? numbers : expected, expected);
    }
}

TEST_F(HostTable, Semaphores) {
    Enabled enabled;
    enabled.timeline_semaphore = true;
    make_host(enabled);
    Context context = make(host());
    const Scene scene(context);
    if (!host().timeline_semaphore) {
        expect_timelines_refused(context, scene.small());
        return;
    }
    const HostSemaphore timeline(host(), VK_SEMAPHORE_TYPE_TIMELINE);
    // An invalid semaphore is reported by name, and nothing is submitted.
    const auto refusal = [&](const Submission& submission) {
        const Status status = context.submit(scene.small(), submission).error();
        EXPECT_EQ(status.code(), StatusCode::invalid_submission) << status.text();
        return status.message();
    };
    const SemaphoreSignal good{timeline.get(), 1};
    const SemaphoreWait null_wait{};
    const SemaphoreWait no_stage{timeline.get(), 0};
    const std::array<SemaphoreSignal, 2> one_null{{good, {}}};
    EXPECT_NE(refusal({.waits = {&null_wait, 1}, .signals = {&good, 1}}).find("waits[0].semaphore"),
              std::string::npos);
    EXPECT_NE(refusal({.waits = {&no_stage, 1}, .signals = {&good, 1}}).find("waits[0].stages"),
              std::string::npos);
    EXPECT_NE(refusal({.signals = one_null}).find("signals[1].semaphore"), std::string::npos);
    EXPECT_EQ(timeline.value(), 0U);
}

TEST_F(HostTable, Waits) {
    make_host();
    std::set<std::string> names;
    {
        // Created, grown, with an uncollected ticket, and destroyed, in both modes.
        Context context = make(noting_names(host(), names));
        const Scene scene(context);
        HostFrames frames(host(), 2);
        (void)scene.record(scene.small(), frames, 0);
        (void)scene.run(scene.small(0.002));
        const Expected<Ticket> ticket = context.submit(scene.small());
        EXPECT_TRUE(ticket.has_value());
    }
    EXPECT_TRUE(names.contains("vkWaitForFences"));
    EXPECT_FALSE(names.contains("vkDeviceWaitIdle"));
    EXPECT_FALSE(names.contains("vkQueueWaitIdle"));
    // Each of its own submissions is waited for once, and recorded ones not at all.
    int waits = 0;
    {
        Context context =
            make(watch([&](const WatchedCall& call) { waits += call.name == "vkWaitForFences"; }));
        EXPECT_EQ(waits, 0);
        const Scene scene(context);
        HostFrames frames(host(), 2);
        (void)scene.record(scene.every(), frames, 0);
        (void)scene.record(scene.small(0.002), frames, 1);
        EXPECT_EQ(waits, 0);
        (void)scene.run(scene.small());
        EXPECT_EQ(waits, 1);
        const Expected<Ticket> recorded =
            context.record(scene.small(), {.commands = frames.begin(2), .frame = 2});
        EXPECT_TRUE(recorded.has_value());
        frames.abandon(2);
        context.frame_completed(2);  // never begun
    }
    EXPECT_EQ(waits, 1);
}

TEST_F(HostTable, Lifetime) {
    make_host();
    for (std::uint32_t in_flight = 1; in_flight <= max_batches_in_flight; ++in_flight) {
        SCOPED_TRACE(in_flight);
        Context context = make(host(), in_flight);
        const Scene scene(context);
        HostFrames frames(host(), in_flight);
        // Each needs a larger atlas than the previous one, which is still in flight.
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
                .error()
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
