
#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>

#include <map>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::MockDriver;
using test_support::name_of;

/// Where shaders find what they count.
constexpr std::uint32_t output_binding = 3;

/// More samples than the initial capacity, in a grid of this many cells.
constexpr std::uint32_t samples = 12000;
constexpr double cells_to_a_unit = 100.0;

/// A context with a batch in flight whose samples exceed the capacity.
class Crowded {
public:
    explicit Crowded(Technique technique) : world_(technique) {
        world_.take_all_before(World::Step::submit_first);
        driver().let_shaders_find({output_binding, samples});
        const Expected<Ticket> ticket = world_.context().submit(world_.overlap(cells_to_a_unit));
        EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
        ticket_ = ticket.has_value() ? *ticket : Ticket{};
    }

    [[nodiscard]] World& world() { return world_; }
    [[nodiscard]] MockDriver& driver() { return world_.driver(); }
    Status collect() { return world_.context().collect(ticket_, results_); }
    [[nodiscard]] std::size_t found() const {
        return std::get<IntersectionResult>(results_.results.at(0)).samples.size();
    }
    /// Another such batch is answered; then everything is destroyed and nothing remains.
    void expect_to_answer() {
        const Status status = world_.context().run(world_.overlap(cells_to_a_unit), results_);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(found(), samples);
    }
    void expect_to_leave_nothing() {
        EXPECT_TRUE(world_.take(World::Step::destroy).ok());
        EXPECT_EQ(driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(driver().breaches(), std::vector<std::string>{});
    }

private:
    World world_;
    Ticket ticket_;
    Results results_;
};

TEST(Resubmission, GivesSamplesThatFoundNoneRoomAndTheNextBatchAtOnce) {
    for (const Technique technique : device_techniques) {
        SCOPED_TRACE(to_string(technique));
        Crowded crowded(technique);
        EXPECT_EQ(crowded.driver().submissions().size(), 1U);
        const Status status = crowded.collect();
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(crowded.found(), samples);
        EXPECT_EQ(crowded.driver().submissions().size(), 2U);
        crowded.expect_to_answer();
        EXPECT_EQ(crowded.driver().submissions().size(), 3U);
        crowded.expect_to_leave_nothing();
    }
}

std::vector<std::string_view> calls_of_collecting(Technique technique) {
    Crowded crowded(technique);
    crowded.driver().forget_calls();
    EXPECT_TRUE(crowded.collect().ok());
    return crowded.driver().calls();
}

void try_error(Technique technique, std::string_view call, std::size_t successes, VkResult error) {
    SCOPED_TRACE(::testing::Message() << to_string(technique) << ": call " << successes << " of "
                                      << call << " says " << name_of(error));
    Crowded crowded(technique);
    crowded.driver().fail(call, successes, error, MockDriver::Failing::from_then_on);
    const Status status = crowded.collect();
    crowded.driver().work_again();
    ASSERT_TRUE(crowded.driver().has_failed());
    EXPECT_EQ(status.code(), code_of(error)) << status.text();
    EXPECT_NE(status.message().find(call), std::string::npos) << status.text();
    EXPECT_NE(status.message().find(name_of(error)), std::string::npos) << status.text();
    if (error != VK_ERROR_DEVICE_LOST) {
        crowded.expect_to_answer();
    }
    crowded.expect_to_leave_nothing();
}

TEST(Resubmission, ThatFailsIsNamedLeaksNothingAndLeavesAContextThatAnswers) {
    for (const Technique technique : device_techniques) {
        std::map<std::string_view, std::size_t> count;
        for (const std::string_view call : calls_of_collecting(technique)) {
            for (const VkResult error : errors_of(call)) {
                try_error(technique, call, count[call], error);
            }
            ++count[call];
        }
        EXPECT_EQ(count["vkWaitForFences"], 2U);
        EXPECT_EQ(count["vkQueueSubmit"], 1U);
        EXPECT_EQ(count["vkCreateBuffer"], 1U) << "results need more room";
    }
}

}  // namespace
}  // namespace nearfield::test
