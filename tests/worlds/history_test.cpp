#include "history.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace nearfield::test {
namespace {

/// Runs every job on its own thread.
void run_on_threads(void* /*user*/, std::uint32_t jobs, void (*job)(void* data, std::uint32_t),
                    void* data) {
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < jobs; ++i) {
        threads.emplace_back(job, data, i);
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

TEST(WorldHistory, DoesNotShow) {
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(80); ++number) {
        const auto seed = static_cast<std::uint64_t>(number);
        Settings settings;
        if (number % 4 == 0) {
            settings.jobs = {nullptr, 3, run_on_threads};
        }
        History history(seed, settings);
        Random random(seed + 1);
        const int questions = random.whole(2, 5);
        for (int asked = 0; asked < questions; ++asked) {
            for (int steps = random.whole(0, 20); steps > 0; --steps) {
                history.step();
            }
            const std::string difference = history.compare();
            ASSERT_EQ(difference, "") << "history " << number << ": " << history.log();
        }
    }
}

}  // namespace
}  // namespace nearfield::test
