#pragma once

#include <tests/query/query_test.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/fake_loader.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {

/// Frames that make nothing once those before them have warmed up: a context whose calls to the
/// driver are counted. Allocations of the driver and the validation layers are counted separately.
class SteadyStateTest : public QueryTest {
protected:
    void SetUp() override;
    void TearDown() override;

    [[nodiscard]] Context& watched() { return *watched_; }
    /// One query of each kind that a simulation frame needs, by every technique.
    [[nodiscard]] const Batch& batch() const { return batch_; }
    [[nodiscard]] std::vector<ShapeHandle> shapes_of_frame() const { return {a_, b_}; }
    /// Both shapes take their next form.
    [[nodiscard]] bool deform(int frame);

    /// Calls `frame(number)`, which returns whether it succeeded, first to warm up and then as
    /// often as requested, and expects no creation or allocation in the second part.
    template <class Frame>
    void expect_nothing_made(int frames, const Frame& frame) {
        constexpr int warm_up = 24;
        for (int i = 0; i < warm_up; ++i) {
            ASSERT_TRUE(frame(i)) << "frame " << i;
        }
        created.clear();
        waits_and_submissions = 0;
        allocations_below = 0;
        const std::uint64_t before = test_support::allocation_count_of_this_thread();
        int failures = 0;
        for (int i = warm_up; i < warm_up + frames; ++i) {
            failures += frame(i) ? 0 : 1;
        }
        const std::uint64_t all = test_support::allocation_count_of_this_thread() - before;
        EXPECT_EQ(failures, 0);
        EXPECT_EQ(created, std::vector<std::string>());
        EXPECT_EQ(all - allocations_below, 0U) << "in " << frames << " frames";
    }

    /// Work of the host itself does not count.
    template <class Action>
    static void by_others(const Action& action) {
        const std::uint64_t before = test_support::allocation_count_of_this_thread();
        action();
        allocations_below += test_support::allocation_count_of_this_thread() - before;
    }

    static void expect_answers(const Results& results);

    static std::uint64_t allocations_below;
    static std::vector<std::string> created;  ///< entry points that create or destroy objects
    static int waits_and_submissions;

private:
    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> watched_;
    std::vector<Rings> rings_a_;
    std::vector<Rings> rings_b_;
    ShapeHandle a_;
    ShapeHandle b_;
    Batch batch_;
};

}  // namespace nearfield::test
