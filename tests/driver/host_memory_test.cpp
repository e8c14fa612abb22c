#include <nearfield/diagnostics.hpp>

#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/allocations.hpp>

#include <algorithm>

namespace nearfield::test {
namespace {

using test_support::FailingAllocations;

/// How many of a step's allocations are made to fail: all if there are few, otherwise this many,
/// spread over all.
constexpr std::uint64_t max_tries = 50;

bool is_submission(World::Step step) {
    return step == World::Step::submit_first || step == World::Step::submit_larger ||
           step == World::Step::submit_without_work || step == World::Step::submit_last;
}

std::uint64_t allocations_of(Technique technique, World::Step step) {
    World world(technique);
    world.take_all_before(step);
    const std::uint64_t before = test_support::allocation_count_of_this_thread();
    EXPECT_TRUE(world.take(step).ok());
    return test_support::allocation_count_of_this_thread() - before;
}

/// Makes host memory run out permanently after a number of allocations of a step, and again when
/// the step is tried again; then memory is available again.
void try_without_memory(Technique technique, World::Step step, std::uint64_t successes,
                        const std::vector<double>& expected) {
    SCOPED_TRACE(::testing::Message() << to_string(technique) << ", " << to_string(step)
                                      << ": memory for " << successes << " allocations");
    World world(technique);
    world.take_all_before(step);
    bool has_started = false;
    const auto take_in_vain = [&] {
        Status status;
        {
            const FailingAllocations scarce(successes);
            status = world.take(step);
        }
        if (step == World::Step::submit_first && !status.ok()) {
            EXPECT_TRUE(world.is_before_first()) << "semaphores are on their way, and no batch is";
        }
        // Sorting falls back to a method without the memory that it requests.
        const bool has_failed = FailingAllocations::has_failed();
        has_started = status.ok();
        if (has_failed && status.ok() && is_submission(step)) {
            status = world.take(World::Step::collect_first);  // which reports later errors
        }
        EXPECT_EQ(status.code(), has_failed ? StatusCode::out_of_memory : StatusCode::ok)
            << status.text();
    };
    take_in_vain();
    if (!world.has_context() || (World::starts_a_batch(step) && !has_started)) {
        take_in_vain();
    }
    const bool anew = !world.has_context();
    if (anew) {
        EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
        EXPECT_TRUE(world.take(World::Step::create).ok());
    }
    if (anew || step == World::Step::add_shapes) {
        EXPECT_TRUE(world.take(World::Step::add_shapes).ok());
    }
    if (World::starts_a_batch(step) && !has_started) {
        const Status again = world.take(step);
        EXPECT_TRUE(again.ok()) << again.text();
    }
    std::vector<double> numbers;
    const Status next = world.answer(numbers);
    EXPECT_TRUE(next.ok()) << next.text();
    EXPECT_EQ(numbers, expected);
    EXPECT_TRUE(world.take(World::Step::destroy).ok());
    EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
    EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
}

TEST(HostMemory, ThatRunsOutIsSaidAndLeavesAContextThatAnswers) {
    for (const Technique technique : device_techniques) {
        const std::vector<double> expected = World::undisturbed(technique);
        for (const World::Step step : World::steps) {
            const std::uint64_t count = allocations_of(technique, step);
            const std::uint64_t stride = std::max<std::uint64_t>(1, count / max_tries);
            for (std::uint64_t successes = 0; successes < count; successes += stride) {
                try_without_memory(technique, step, successes, expected);
                if (HasFailure()) {
                    return;
                }
            }
        }
    }
}

TEST(HostMemory, ThatRunsOutDoesNotSpoilWhatIsKeptForTheNextPairs) {
    const std::vector<Ring> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    bool has_failed = true;
    for (std::uint64_t successes = 0; has_failed; ++successes) {
        SCOPED_TRACE(::testing::Message() << "memory for " << successes << " allocations");
        Expected<Context> context = Context::create_cpu();
        ASSERT_TRUE(context.has_value()) << context.error().text();
        const Expected<ShapeHandle> shape = context->add_shape(square);
        ASSERT_TRUE(shape.has_value()) << shape.error().text();
        std::vector<Instance> row;
        for (int i = 0; i < 10; ++i) {
            row.push_back({*shape, {{0.75 * i, 0.0}}});
        }
        StatusCode code = StatusCode::ok;
        {
            const FailingAllocations scarce(successes);
            code = context->find_overlapping_boxes(row, 0.0).error().code();
            has_failed = FailingAllocations::has_failed();
        }
        EXPECT_EQ(code, has_failed ? StatusCode::out_of_memory : StatusCode::ok);
        const auto pairs = context->find_overlapping_boxes(row, 0.0);
        ASSERT_TRUE(pairs.has_value()) << pairs.error().text();
        EXPECT_EQ(pairs->size(), 9U);
    }
}

/// Without host memory, a context can still report that and the loss of its device.
TEST(HostMemory, IsNotNeededToSayWhatIsWrong) {
    World world(device_techniques.front());
    world.take_all_before(World::Step::submit_first);
    Results results;
    const Batch batch = world.batch(8);
    {
        const FailingAllocations none(0);
        const Status status = world.context().run(batch, results);
        EXPECT_EQ(status.code(), StatusCode::out_of_memory);
        EXPECT_EQ(*describe_graph(world.context(), GraphFormat::text), "");
    }
    const Expected<Ticket> ticket = world.context().submit(batch);
    ASSERT_TRUE(ticket.has_value());
    world.driver().fail("vkWaitForFences", 0, VK_ERROR_DEVICE_LOST,
                        test_support::MockDriver::Failing::once);
    EXPECT_EQ(world.context().collect(*ticket, results).code(), StatusCode::device_lost);
    const FailingAllocations none(0);
    const Status status = world.context().run(batch, results);
    EXPECT_EQ(status.code(), StatusCode::device_lost);
    EXPECT_NE(status.message(), "");
}

}  // namespace
}  // namespace nearfield::test
