#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::MockDriver;
using test_support::name_of;
using Passed = std::vector<MockDriver::Submitted::Semaphore>;

/// Both kinds of semaphores, to wait for and to signal.
struct Order {
    explicit Order(MockDriver& driver)
        : begun(driver.make_timeline_semaphore(5)),
          done(driver.make_timeline_semaphore(5)),
          before(driver.make_semaphore(true)),
          after(driver.make_semaphore(false)),
          waits{{begun, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 4},
                {before, VK_PIPELINE_STAGE_TRANSFER_BIT}},
          signals{{after}, {done, 7}} {}

    [[nodiscard]] Submission submission() const { return {.waits = waits, .signals = signals}; }
    void expect_passed(const MockDriver& driver, bool passed) const {
        EXPECT_EQ(driver.value_of(begun), 5U);
        EXPECT_EQ(driver.value_of(done), passed ? 7U : 5U);
        EXPECT_EQ(driver.is_signalled(before), !passed);
        EXPECT_EQ(driver.is_signalled(after), passed);
    }

    VkSemaphore begun, done, before, after;
    SemaphoreWait waits[2];
    SemaphoreSignal signals[2];
};

/// A context whose host enabled timeline semaphores.
class Semaphores : public ::testing::TestWithParam<bool> {
protected:
    Semaphores() {
        driver().enable_timeline_semaphores();
        world_.take_all_before(World::Step::submit_first);
    }
    ~Semaphores() override {
        EXPECT_TRUE(world_.take(World::Step::destroy).ok());
        EXPECT_EQ(driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(driver().breaches(), std::vector<std::string>{});
    }

    [[nodiscard]] MockDriver& driver() { return world_.driver(); }
    /// The parameter: whether there is work for the device, or only semaphores.
    [[nodiscard]] Batch batch() const { return GetParam() ? world_.overlap(8) : Batch(); }
    Status run(const Submission& submission) {
        const Expected<Ticket> ticket = world_.context().submit(batch(), submission);
        if (!ticket) {
            return ticket.error();
        }
        Results results;
        return world_.context().collect(*ticket, results);
    }

    World world_{device_techniques.front()};
};

TEST_P(Semaphores, ReachTheQueueWithTheirValuesAndStages) {
    const Order order(driver());
    const Status status = run(order.submission());
    ASSERT_TRUE(status.ok()) << status.text();
    ASSERT_EQ(driver().submissions().size(), 1U);
    const MockDriver::Submitted& submitted = driver().submissions().back();
    EXPECT_EQ(submitted.waits, (Passed{{order.begun, 4, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT},
                                       {order.before, 0, VK_PIPELINE_STAGE_TRANSFER_BIT}}));
    EXPECT_EQ(submitted.signals, (Passed{{order.after, 0, 0}, {order.done, 7, 0}}));
    EXPECT_EQ(submitted.command_buffers, GetParam() ? 1U : 0U);
    order.expect_passed(driver(), true);
}

/// The same semaphores serve the next batch.
TEST_P(Semaphores, AreAsTheyWereWhereTheSubmissionFails) {
    for (const VkResult error : errors_of("vkQueueSubmit")) {
        SCOPED_TRACE(name_of(error));
        const Order order(driver());
        driver().fail("vkQueueSubmit", 0, error, MockDriver::Failing::once);
        const Status status = run(order.submission());
        EXPECT_EQ(status.code(), code_of(error)) << status.text();
        EXPECT_NE(status.message().find("vkQueueSubmit"), std::string::npos) << status.text();
        order.expect_passed(driver(), false);
        if (error != VK_ERROR_DEVICE_LOST) {
            EXPECT_TRUE(run(order.submission()).ok());
            order.expect_passed(driver(), true);
        }
    }
}

TEST_P(Semaphores, WithValuesAreRefusedWhereTheHostDidNotEnableThem) {
    EXPECT_TRUE(world_.take(World::Step::destroy).ok());
    driver().enable_timeline_semaphores(false);
    EXPECT_TRUE(world_.take(World::Step::create).ok());
    EXPECT_TRUE(world_.take(World::Step::add_shapes).ok());
    const Order order(driver());
    EXPECT_EQ(run(order.submission()).code(), StatusCode::invalid_submission);
    order.expect_passed(driver(), false);
    // Without timeline semaphores, the queue gets no structure of values; the mock driver checks
    // that.
    const Submission binary{.waits = {&order.waits[1], 1}, .signals = {&order.signals[0], 1}};
    EXPECT_TRUE(run(binary).ok());
    EXPECT_EQ(driver().submissions().size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(With, Semaphores, ::testing::Bool(),
                         [](const auto& with) { return with.param ? "Work" : "NoWork"; });

}  // namespace
}  // namespace nearfield::test
