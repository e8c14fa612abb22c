#include <gtest/gtest.h>
#include <tools/cli/options.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace nearfield::tools {
namespace {

/// How often each job was done.
struct Done {
    explicit Done(std::uint32_t jobs) : times(jobs) {}

    static void job(void* data, std::uint32_t number) {
        // The last ones are still at work when the others are done.
        std::this_thread::sleep_for(std::chrono::microseconds(number % 3 == 2 ? 2000 : 0));
        ++static_cast<Done*>(data)->times[number];
    }

    std::vector<std::atomic<int>> times;
};

TEST(ThreadTeam, ReturnsWhenEveryJobIsDoneOnce) {
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
        ThreadTeam team(threads);
        const JobSystem system = team.jobs();
        ASSERT_GE(system.count, threads);
        for (std::uint32_t jobs = 1; jobs <= system.count; ++jobs) {
            Done done(jobs);
            system.run(system.user, jobs, &Done::job, &done);
            EXPECT_TRUE(std::all_of(done.times.begin(), done.times.end(),
                                    [](const auto& times) { return times == 1; }))
                << jobs << " jobs on " << threads << " threads";
        }
    }
}

}  // namespace
}  // namespace nearfield::tools
