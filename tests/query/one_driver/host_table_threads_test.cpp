#include <tests/query/host_table.hpp>

#include <atomic>
#include <mutex>
#include <thread>
#include <utility>

namespace nearfield::test {
namespace {

/// A queue that several threads use, each through its own context.
struct SharedQueue {
    std::mutex mutex;
    std::atomic<int> inside{0};
    std::atomic<int> locked{0};
    std::atomic<int> collisions{0};
    std::atomic<int> submitted{0};
    HostDevice host;

    void enter() {
        mutex.lock();
        collisions += inside++ == 0 ? 0 : 1;
        ++locked;
    }
    void leave() {
        --inside;
        mutex.unlock();
    }
    VkResult submit(std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
        ++submitted;
        enter();
        const VkResult result = test_support::host_function<PFN_vkQueueSubmit>(
            host, "vkQueueSubmit")(host.queue, count, infos, fence);
        leave();
        return result;
    }
};

TEST_F(HostTable, Threads) {
    make_host();
    SharedQueue queue;
    queue.host = host();
    HostDevice locking = host();
    locking.queue_access.user = &queue;
    locking.queue_access.lock = [](void* user) { static_cast<SharedQueue*>(user)->enter(); };
    locking.queue_access.unlock = [](void* user) { static_cast<SharedQueue*>(user)->leave(); };
    // A host whose queue is available only through its own function.
    HostDevice by_host = host();
    by_host.queue = VK_NULL_HANDLE;
    by_host.queue_access.user = &queue;
    by_host.queue_access.submit = [](void* user, std::uint32_t count, const VkSubmitInfo* infos,
                                     VkFence fence) {
        return static_cast<SharedQueue*>(user)->submit(count, infos, fence);
    };
    constexpr int batches = 5;
    std::vector<std::vector<double>> answers(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        threads.emplace_back([&, i] {
            Context context = make(i % 2 == 0 ? locking : by_host);
            const Scene scene(context);
            for (int batch = 0; batch < batches; ++batch) {
                answers[i] = scene.run(scene.small());
            }
            const Expected<Ticket> in_flight = context.submit(scene.small());
            EXPECT_TRUE(in_flight.has_value());
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_FALSE(answers[0].empty());
    for (const std::vector<double>& answer : answers) {
        EXPECT_EQ(answer, answers[0]);
    }
    EXPECT_EQ(queue.collisions, 0);
    EXPECT_EQ(queue.inside, 0);
    EXPECT_EQ(queue.locked, 4 * (batches + 1));
    EXPECT_EQ(queue.submitted, 2 * (batches + 1));
    // Half of a lock is an error.
    HostDevice half = locking;
    half.queue_access.unlock = nullptr;
    const Status status = Context::create(half).error();
    EXPECT_EQ(status.code(), StatusCode::invalid_settings);
    EXPECT_NE(status.message().find("queue_access.unlock is null"), std::string::npos)
        << status.text();
    std::swap(half.queue_access.lock, half.queue_access.unlock);
    EXPECT_NE(Context::create(half).error().message().find("queue_access.lock is null"),
              std::string::npos);
}

/// A host whose submissions all have a fence of its own.
struct FencedQueue {
    HostDevice host;
    VkFence fence = VK_NULL_HANDLE;
    int submissions = 0;
    int fences_given = 0;

    explicit FencedQueue(const HostDevice& device) : host(device) {
        VkFenceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        EXPECT_EQ(test_support::host_function<PFN_vkCreateFence>(host, "vkCreateFence")(
                      host.device, &info, nullptr, &fence),
                  VK_SUCCESS);
    }
    ~FencedQueue() {
        test_support::host_function<PFN_vkDestroyFence>(host, "vkDestroyFence")(host.device, fence,
                                                                                nullptr);
    }
    FencedQueue(const FencedQueue&) = delete;
    FencedQueue& operator=(const FencedQueue&) = delete;

    VkResult submit(std::uint32_t count, const VkSubmitInfo* infos, VkFence given) {
        ++submissions;
        fences_given += given == VK_NULL_HANDLE ? 0 : 1;
        const VkResult result = test_support::host_function<PFN_vkQueueSubmit>(
            host, "vkQueueSubmit")(host.queue, count, infos, fence);
        test_support::host_function<PFN_vkWaitForFences>(host, "vkWaitForFences")(
            host.device, 1, &fence, VK_TRUE, UINT64_MAX);
        test_support::host_function<PFN_vkResetFences>(host, "vkResetFences")(host.device, 1,
                                                                              &fence);
        return result;
    }
};

TEST_F(HostTable, FencesOfTheHost) {
    test_support::Enabled enabled;
    enabled.timeline_semaphore = true;
    HostDevice device = make_host(enabled);
    const bool has_timelines = device.timeline_semaphore;
    device.timeline_semaphore = false;
    device.completion_by_timeline = true;
    const Status status = Context::create(device).error();
    EXPECT_EQ(status.code(), StatusCode::invalid_settings);
    EXPECT_NE(status.message().find("completion_by_timeline"), std::string::npos) << status.text();
    if (!has_timelines) {
        return;
    }
    std::vector<double> expected;
    {
        Context context = make(host());
        const Scene scene(context);
        expected = scene.run(scene.every());
    }
    device.timeline_semaphore = true;
    FencedQueue queue(device);
    device.queue = VK_NULL_HANDLE;
    device.queue_access.user = &queue;
    device.queue_access.submit = [](void* user, std::uint32_t count, const VkSubmitInfo* infos,
                                    VkFence fence) {
        return static_cast<FencedQueue*>(user)->submit(count, infos, fence);
    };
    {
        Context context = make(device);
        const Scene scene(context);
        for (int round = 0; round < 3; ++round) {
            EXPECT_EQ(scene.run(scene.every()), expected);
        }
        const Expected<Ticket> in_flight = context.submit(scene.small());
        ASSERT_TRUE(in_flight.has_value());
        // lavapipe may signal the fence a moment before the semaphore's value can be read.
        while (!context.is_ready(*in_flight)) {
            std::this_thread::yield();
        }
    }
    EXPECT_GE(queue.submissions, 4);
    EXPECT_EQ(queue.fences_given, 0);
}

}  // namespace
}  // namespace nearfield::test
