#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/mock_driver.hpp>

#include <algorithm>

namespace nearfield::test {
namespace {

using test_support::MockDriver;

TEST(MockDriver, HasNothingToComplainOfALifeWithoutFailures) {
    for (const Technique technique : device_techniques) {
        World world(technique);
        for (const World::Step step : World::steps) {
            SCOPED_TRACE(to_string(step));
            const Status status = world.take(step);
            ASSERT_TRUE(status.ok()) << status.text();
            EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
            EXPECT_EQ(world.driver().alive().empty(), step == World::Step::destroy);
            const auto& calls = world.driver().calls();
            const auto asks = [&](std::string_view call) {
                return std::find(calls.begin(), calls.end(), call) != calls.end();
            };
            const bool is_new = step == World::Step::submit_first ||
                                step == World::Step::submit_larger ||
                                step == World::Step::record_last;
            // What is recorded has room for all samples, which can be more than there was.
            if (step != World::Step::record) {
                EXPECT_EQ(asks("vkCreateBuffer"), is_new);
            }
            EXPECT_EQ(asks("vkCreateImage"), is_new);
            const bool submits =
                step == World::Step::submit_first || step == World::Step::submit_larger ||
                step == World::Step::submit_without_work || step == World::Step::submit_last;
            EXPECT_EQ(asks("vkQueueSubmit"), submits) << "what is recorded is the host's to submit";
            const bool reads_results =
                step == World::Step::collect_first || step == World::Step::collect_larger ||
                step == World::Step::collect_recorded || step == World::Step::collect_unexecuted;
            EXPECT_EQ(asks("vkInvalidateMappedMemoryRanges"), reads_results);
            EXPECT_TRUE(step >= World::Step::submit_first && step < World::Step::submit_without_work
                            ? world.is_after_first()
                            : world.is_before_first());
            world.driver().forget_calls();
        }
    }
}

TEST(MockDriver, ComplainsOfEveryCallWithoutTheHostsAllocator) {
    const MockDriver driver;
    HostDevice host = driver.host();
    host.allocator = nullptr;
    EXPECT_TRUE(Context::create(host).has_value());
    const auto makes_or_destroys = [](std::string_view call) {
        return call.starts_with("vkCreate") || call.starts_with("vkDestroy") ||
               call == "vkAllocateMemory" || call == "vkFreeMemory";
    };
    const auto calls =
        std::count_if(driver.calls().begin(), driver.calls().end(), makes_or_destroys);
    EXPECT_GT(calls, 0);
    EXPECT_EQ(driver.breaches().size(), static_cast<std::size_t>(calls));
}

/// The batches of a context share images, which are recreated for larger batches.
TEST(MockDriver, FindsAllThatWasRecordedThereThoughLaterBatchesAreLarger) {
    for (const Technique technique : device_techniques) {
        World world(technique);
        world.take_all_before(World::Step::submit_first);
        Context& context = world.context();
        const VkCommandBuffer commands = world.driver().begin_commands();
        const Expected<Ticket> recorded =
            context.record(world.batch(8), {.commands = commands, .frame = 1});
        ASSERT_TRUE(recorded.has_value()) << recorded.error().text();
        Results results;
        for (const double cells : {100.0, 200.0}) {
            const Status status = context.run(world.batch(cells), results);
            EXPECT_TRUE(status.ok()) << status.text();
        }
        world.driver().submit(commands);
        world.driver().finish_submissions();
        context.frame_completed(1);
        const Status status = context.collect(*recorded, results);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
    }
}

}  // namespace
}  // namespace nearfield::test
