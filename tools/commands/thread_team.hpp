#pragma once

#include <nearfield/jobs.hpp>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace nearfield::tools {

/// Threads that wait for the jobs of a context, and the thread that brings them: what a host's job
/// system is to the library. For one context at a time.
class ThreadTeam {
public:
    /// `count`: threads in all, at least 1; all but one are started here.
    explicit ThreadTeam(std::uint32_t count);
    /// Precondition: no jobs are running.
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    /// For Settings::jobs; the team must outlive the context.
    [[nodiscard]] JobSystem jobs();

private:
    using Job = void (*)(void* data, std::uint32_t number);

    void run(std::uint32_t jobs, Job job, void* data);
    void work();
    /// Does jobs as long as there are any.
    void take_jobs();

    std::vector<std::thread> threads_;  // all but the one that calls
    std::mutex mutex_;
    std::condition_variable begun_;
    std::condition_variable ended_;
    std::uint64_t round_ = 0;  // how often jobs were brought
    std::uint32_t working_ = 0;
    bool over_ = false;
    // Of the round; read by those who work on it.
    Job job_ = nullptr;
    void* data_ = nullptr;
    std::uint32_t count_ = 0;
    std::atomic<std::uint32_t> next_ = 0;
};

}  // namespace nearfield::tools
