#include <engine/base/jobs.hpp>
#include <engine/base/status_exception.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace nearfield {
namespace {

/// Runs the jobs one after the other, the last first, and leaves one of them out if asked to.
struct Host {
    static constexpr std::uint32_t none = 1000;
    std::uint32_t left_out = none;

    static void run(void* user, std::uint32_t jobs, void (*job)(void*, std::uint32_t), void* data) {
        for (std::uint32_t i = jobs; i-- > 0;) {
            if (i != static_cast<const Host*>(user)->left_out) {
                job(data, i);
            }
        }
    }

    JobSystem system() { return {this, 8, run}; }
};

TEST(Jobs, RunEachOnce) {
    Host host;
    Jobs jobs(host.system());
    for (const std::uint32_t count : {1U, 2U, 8U, 3U}) {
        std::vector<int> runs(8);
        jobs.run(count, [&](std::uint32_t job) { ++runs[job]; });
        for (std::uint32_t i = 0; i < runs.size(); ++i) {
            EXPECT_EQ(runs[i], i < count ? 1 : 0) << i << " of " << count;
        }
    }
}

TEST(Jobs, AJobLeftOutIsAnError) {
    Host host;
    Jobs jobs(host.system());
    const auto nothing = [](std::uint32_t) {};
    // It was done by the call before.
    jobs.run(8, nothing);
    for (const std::uint32_t left_out : {0U, 5U, 7U}) {
        host.left_out = left_out;
        try {
            jobs.run(8, nothing);
            FAIL() << "job " << left_out << " was not missed";
        } catch (const StatusException& failure) {
            EXPECT_EQ(failure.status().code(), StatusCode::invalid_settings);
            EXPECT_NE(failure.status().message().find("job " + std::to_string(left_out) + " of 8"),
                      std::string::npos)
                << failure.status().message();
        }
    }
    host.left_out = Host::none;
    jobs.run(8, nothing);
}

TEST(Jobs, TheFirstOfSeveralFailuresIsThrown) {
    Host host;
    Jobs jobs(host.system());
    try {
        jobs.run(8, [](std::uint32_t job) {
            if (job == 2 || job == 3 || job == 6) {
                throw std::runtime_error(std::to_string(job));
            }
        });
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& failure) {
        EXPECT_STREQ(failure.what(), "2");
    }
    // No failure of an earlier call is left.
    jobs.run(8, [](std::uint32_t) {});
}

TEST(Jobs, DivideAllThingsIntoParts) {
    Host host;
    Jobs jobs(host.system());
    for (const std::size_t count : {0U, 1U, 9U, 10U, 11U, 80U, 81U, 1000U}) {
        std::vector<int> seen(count);
        jobs.divide(count, 10, [&](std::uint32_t job, std::size_t first, std::size_t end) {
            EXPECT_LT(job, 8U);
            EXPECT_LE(end - first, 10U);
            for (std::size_t i = first; i < end; ++i) {
                ++seen[i];
            }
        });
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(seen[i], 1) << i << " of " << count;
        }
    }
}

}  // namespace
}  // namespace nearfield
