#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace nearfield::test {
namespace {

using test_support::EntryPoint;
using test_support::errors_of;
using test_support::MockDriver;
using test_support::name_of;

/// Whether a step calls it: without technique raster none draws.
bool is_called(const EntryPoint& entry) {
    constexpr std::string_view of_drawing[] = {
        "RenderPass", "Framebuffer", "Graphics", "vkCmdDraw", "VertexBuffers", "vkCmdSet", "Query"};
    return has_raster || std::none_of(std::begin(of_drawing), std::end(of_drawing),
                                      [&entry](std::string_view part) {
                                          return entry.name.find(part) != std::string_view::npos;
                                      });
}

/// One way in which a driver can fail.
struct DriverFailure {
    World::Step step{};
    std::string_view call;
    std::size_t successes = 0;  ///< of that call in the step before the failure
    VkResult error = VK_SUCCESS;

    friend std::ostream& operator<<(std::ostream& out, const DriverFailure& failure) {
        return out << "call " << failure.successes << " of " << failure.call << " says "
                   << name_of(failure.error) << " in: " << to_string(failure.step);
    }
};

/// All failures to try, derived from a run without failures, for the steps that call the driver:
/// each call is made to fail with the first of its errors, and with every one of its errors if it
/// is the first such call in a step, creates the context, or allocates memory.
std::vector<DriverFailure> all_failures(Technique technique) {
    std::vector<DriverFailure> failures;
    World world(technique);
    for (const World::Step step : World::steps) {
        world.driver().forget_calls();
        EXPECT_TRUE(world.take(step).ok());
        std::map<std::string_view, std::size_t> count;
        for (const std::string_view call : world.driver().calls()) {
            for (const VkResult error : errors_of(call)) {
                failures.push_back({step, call, count[call], error});
                const bool first_error_will_do = count[call] > 0 && call != "vkAllocateMemory";
                if (first_error_will_do && step != World::Step::create) {
                    break;
                }
            }
            ++count[call];
        }
    }
    return failures;
}

/// After device loss: every call reports it, makes no more driver calls, and everything is
/// released.
void expect_lost(World& world, Ticket in_flight) {
    Context& context = world.context();
    Results results;
    EXPECT_EQ(context.submit(world.batch(8)).error().code(), StatusCode::device_lost);
    EXPECT_EQ(context.run(world.batch(8), results).code(), StatusCode::device_lost);
    const Recording recording{.commands = world.driver().begin_commands(), .frame = 100};
    EXPECT_EQ(context.record(world.batch(8), recording).error().code(), StatusCode::device_lost);
    EXPECT_EQ(context.on_device(in_flight, QueryHandle<ContactQuery>{}).error().code(),
              StatusCode::device_lost);
    context.frame_completed(recording.frame);
    EXPECT_TRUE(context.is_ready(in_flight));
    EXPECT_EQ(context.add_shape(std::span<const Ring>()).error().code(), StatusCode::device_lost);
    EXPECT_EQ(context.update_shape({}, std::span<const Ring>()).code(), StatusCode::device_lost);
    EXPECT_EQ(context.remove_shape({}).code(), StatusCode::device_lost);
    EXPECT_EQ(context.find_overlapping_boxes({}, 1.0).error().code(), StatusCode::device_lost);
    EXPECT_TRUE(world.take(World::Step::destroy).ok());
    EXPECT_EQ(world.driver().work_after_loss(), std::vector<std::string>{});
}

/// Injects one failure and checks the state of the context afterwards.
void try_failure(Technique technique, const DriverFailure& failure,
                 const std::vector<double>& expected) {
    World world(technique);
    MockDriver& driver = world.driver();
    world.take_all_before(failure.step);
    driver.fail(failure.call, failure.successes, failure.error, MockDriver::Failing::from_then_on);
    const Status status = world.take(failure.step);
    driver.work_again();
    if (failure.step == World::Step::submit_first && !status.ok()) {
        EXPECT_TRUE(world.is_before_first()) << "semaphores are on their way, and no batch is";
    }
    ASSERT_TRUE(driver.has_failed()) << "the life with failures differs from the one without";
    // Calls that ask whether a batch is done, or wait for it at the end, have nobody to report to.
    const bool silent =
        failure.step == World::Step::destroy ||
        (failure.call == "vkGetFenceStatus" && failure.error != VK_ERROR_DEVICE_LOST);
    if (!silent) {
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(status.code(), code_of(failure.error)) << status.text();
        EXPECT_NE(status.message().find(name_of(failure.error)), std::string::npos)
            << status.text();
        const bool lost_earlier =
            failure.call == "vkGetFenceStatus" && failure.error == VK_ERROR_DEVICE_LOST;
        EXPECT_NE(status.message().find(lost_earlier ? "vkWaitForFences" : failure.call),
                  std::string::npos)
            << status.text();
    }
    if (failure.error == VK_ERROR_DEVICE_LOST && world.has_context()) {
        expect_lost(world, {});
    } else if (failure.step == World::Step::create) {
        EXPECT_EQ(driver.alive(), std::vector<std::string>{});
    } else if (world.has_context()) {
        if (World::starts_a_batch(failure.step) && !status.ok()) {
            if (failure.call == "vkAllocateMemory") {  // refused twice in a row
                driver.fail(failure.call, 0, failure.error, MockDriver::Failing::from_then_on);
                EXPECT_EQ(world.take(failure.step).code(), code_of(failure.error));
                driver.work_again();
            }
            const Status again = world.take(failure.step);
            EXPECT_TRUE(again.ok()) << again.text();
        }
        std::vector<double> numbers;
        const Status next = world.answer(numbers);
        EXPECT_TRUE(next.ok()) << next.text();
        EXPECT_EQ(numbers, expected);
        EXPECT_TRUE(world.take(World::Step::destroy).ok());
    }
    EXPECT_EQ(driver.alive(), std::vector<std::string>{});
    EXPECT_EQ(driver.breaches(), std::vector<std::string>{});
}

TEST(FailingCalls, AreNamedLeakNothingAndLeaveAContextThatAnswers) {
    for (const Technique technique : device_techniques) {
        const std::vector<double> expected = World::undisturbed(technique);
        const std::vector<DriverFailure> failures = all_failures(technique);
        for (const DriverFailure& failure : failures) {
            if (technique != device_techniques.front() && failure.step == World::Step::create) {
                continue;  // the same whatever the later request
            }
            SCOPED_TRACE(::testing::Message() << to_string(technique) << ": " << failure);
            try_failure(technique, failure, expected);
            if (::testing::Test::HasFailure()) {
                return;
            }
        }
        RecordProperty(to_string(technique), static_cast<int>(failures.size()));
    }
}

TEST(FailingCalls, CoverEveryEntryPointThatCanFail) {
    std::set<std::string_view> covered;
    for (const Technique technique : device_techniques) {
        for (const DriverFailure& failure : all_failures(technique)) {
            covered.insert(failure.call);
        }
    }
    for (const EntryPoint& entry : test_support::entry_points()) {
        if (entry.returns_result && is_called(entry)) {
            EXPECT_FALSE(errors_of(entry.name).empty())
                << entry.name << " has no row in the table of errors (driver_errors.cpp)";
            EXPECT_TRUE(covered.contains(entry.name))
                << entry.name << " is called in no step (world.cpp)";
        }
    }
}

TEST(FailingCalls, EveryEntryPointThatIsLoadedIsUsed) {
    std::set<std::string_view> used;
    for (const Technique technique : device_techniques) {
        World world(technique);
        world.take_all_before(World::Step::record_last);
        // Large enough for occlusion queries to pay off.
        EXPECT_TRUE(world.context().submit(world.batch(600)).has_value());
        EXPECT_TRUE(world.take(World::Step::destroy).ok());
        used.insert(world.driver().calls().begin(), world.driver().calls().end());
    }
    for (const EntryPoint& entry : test_support::entry_points()) {
        EXPECT_TRUE(used.contains(entry.name) || !is_called(entry))
            << entry.name << " is loaded for nothing";
    }
}

/// Device-local memory is limited, and its host-visible part is small on many cards.
TEST(FailingCalls, MemoryThatIsRefusedOnceIsTakenElsewhere) {
    for (const Technique technique : device_techniques) {
        const std::vector<double> expected = World::undisturbed(technique);
        int taken_elsewhere = 0;
        for (const DriverFailure& failure : all_failures(technique)) {
            if (failure.call != "vkAllocateMemory" ||
                failure.error != VK_ERROR_OUT_OF_DEVICE_MEMORY) {
                continue;
            }
            SCOPED_TRACE(::testing::Message() << to_string(technique) << ": " << failure);
            World world(technique);
            world.take_all_before(failure.step);
            world.driver().fail(failure.call, failure.successes, failure.error,
                                MockDriver::Failing::twice);
            const Status status = world.take(failure.step);
            ASSERT_TRUE(world.driver().has_failed());
            ASSERT_TRUE(status.ok()) << status.text();
            ++taken_elsewhere;
            std::vector<double> numbers;
            EXPECT_TRUE(world.answer(numbers).ok());
            EXPECT_EQ(numbers, expected);
            EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
        }
        EXPECT_GE(taken_elsewhere, 3) << "mapped buffers, other buffers, images";
    }
}

TEST(MissingCalls, AreNamed) {
    for (const EntryPoint& entry : test_support::entry_points()) {
        SCOPED_TRACE(entry.name);
        World world(device_techniques.front());
        world.driver().hide(std::string(entry.name));
        const Status status = world.take(World::Step::create);
        ASSERT_FALSE(status.ok());
        EXPECT_EQ(status.code(), StatusCode::unsupported_device);
        ASSERT_EQ(status.reasons().size(), 1U) << status.text();
        EXPECT_NE(status.reasons()[0].find("entry point " + std::string(entry.name) + ":"),
                  std::string::npos)
            << status.text();
        EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
        world.driver().hide({});
        EXPECT_TRUE(world.take(World::Step::create).ok());
    }
}

TEST(LostDevice, GivesUpEveryBatchInFlightAndCanBeMadeAgain) {
    for (int life = 0; life < 2; ++life) {
        World world(device_techniques.front());
        world.take_all_before(World::Step::submit_first);
        const Expected<Ticket> first = world.context().submit(world.batch(8));
        const Expected<Ticket> second = world.context().submit(world.batch(9));
        ASSERT_TRUE(first.has_value() && second.has_value());
        world.driver().fail("vkWaitForFences", 0, VK_ERROR_DEVICE_LOST, MockDriver::Failing::once);
        Results results;
        const Status status = world.context().collect(*second, results);
        EXPECT_EQ(status.code(), StatusCode::device_lost);
        EXPECT_EQ(world.context().collect(*first, results).code(), StatusCode::device_lost);
        expect_lost(world, *first);
        EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
    }
}

TEST(LostDevice, TakesWhatWasRecordedAlong) {
    World world(device_techniques.front());
    world.take_all_before(World::Step::submit_first);
    const Expected<Ticket> submitted = world.context().submit(world.batch(8));
    const VkCommandBuffer commands = world.driver().begin_commands();
    const Expected<Ticket> recorded =
        world.context().record(world.batch(9), {.commands = commands, .frame = 1});
    ASSERT_TRUE(submitted.has_value() && recorded.has_value());
    world.driver().fail("vkWaitForFences", 0, VK_ERROR_DEVICE_LOST, MockDriver::Failing::once);
    Results results;
    EXPECT_EQ(world.context().collect(*submitted, results).code(), StatusCode::device_lost);
    EXPECT_TRUE(world.context().is_ready(*recorded));
    EXPECT_EQ(world.context().collect(*recorded, results).code(), StatusCode::device_lost);
    expect_lost(world, *recorded);
    EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
    EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
}

TEST(LostDevice, IsNoticedWhereABatchIsAskedForAndNotWaitedFor) {
    World world(Technique::compute);
    world.take_all_before(World::Step::submit_first);
    const Expected<Ticket> ticket = world.context().submit(world.batch(8));
    ASSERT_TRUE(ticket.has_value());
    world.driver().fail("vkGetFenceStatus", 0, VK_ERROR_DEVICE_LOST, MockDriver::Failing::once);
    EXPECT_TRUE(world.context().is_ready(*ticket));
    Results results;
    EXPECT_EQ(world.context().collect(*ticket, results).code(), StatusCode::device_lost);
    expect_lost(world, *ticket);
}

}  // namespace
}  // namespace nearfield::test
