#pragma once

#include <cstdint>
#include <thread>
#include <vector>

namespace nearfield::test {

/// A function for JobSystem::run that runs every job on a thread of its own.
inline void run_on_threads(void* /*user*/, std::uint32_t jobs,
                           void (*job)(void* data, std::uint32_t number), void* data) {
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < jobs; ++i) {
        threads.emplace_back(job, data, i);
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

}  // namespace nearfield::test
