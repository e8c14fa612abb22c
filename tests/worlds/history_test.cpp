#include "history.hpp"

#include <gtest/gtest.h>
#include <tests/support/run_on_threads.hpp>

#include <functional>
#include <memory>
#include <string>

namespace nearfield::test {
namespace {

/// Histories whose worlds are asked some questions, twice to five times.
void expect_not_to_show(int usual, const std::function<QuestionList()>& questions) {
    std::uint32_t kept = 0;
    const int first = first_case();
    for (int number = first; number < first + random_cases(usual); ++number) {
        const auto seed = static_cast<std::uint64_t>(number);
        Settings settings;
        if (number % 4 == 0) {
            settings.jobs = {nullptr, 3, run_on_threads};
        }
        History history(seed, questions, settings);
        Random random(seed + 1);
        for (int asked = random.whole(2, 5); asked > 0; --asked) {
            for (int steps = random.whole(0, 20); steps > 0; --steps) {
                history.step();
            }
            const std::string difference = history.compare();
            ASSERT_EQ(difference, "") << "history " << number << ": " << history.log();
        }
        kept += history.kept();
    }
    EXPECT_GT(kept, 0U) << "nothing was kept";
}

TEST(WorldHistory, DoesNotShow) {
    expect_not_to_show(80, questions_but_about_found_pairs);
}

TEST(WorldHistory, DoesNotShowInTables) {
    expect_not_to_show(10, questions_about_found_pairs);
}

}  // namespace
}  // namespace nearfield::test
