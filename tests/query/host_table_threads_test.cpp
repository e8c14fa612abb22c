#include <tests/query/host_table.hpp>

#include <atomic>
#include <mutex>
#include <thread>

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
    constexpr int tile_batches = 5;
    std::vector<std::vector<double>> answers(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        threads.emplace_back([&, i] {
            Context context = make(i % 2 == 0 ? locking : by_host);
            const Scene scene(context);
            for (int round = 0; round < tile_batches; ++round) {
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
    EXPECT_EQ(queue.locked, 4 * (tile_batches + 1));
    EXPECT_EQ(queue.submitted, 2 * (tile_batches + 1));
    // Half of a lock is an error.
    HostDevice half = locking;
    half.queue_access.unlock = nullptr;
    const Status status = Context::create(half).error();
    EXPECT_EQ(status.code(), StatusCode::unsupported_device);
    ASSERT_EQ(status.reasons().size(), 1U);
    EXPECT_NE(status.reasons()[0].find("queue_access.unlock"), std::string::npos);
}

}  // namespace
}  // namespace nearfield::test
