#pragma once

#include <nearfield/jobs.hpp>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace nearfield::tools {

/// A thread pool for the jobs of a context, including the calling thread; it plays the role of a
/// host's job system. Serves one context at a time.
class ThreadTeam {
public:
    /// `count`: the total number of threads, at least 1; all but the caller's are started here.
    explicit ThreadTeam(std::uint32_t count);
    /// Precondition: no jobs are running.
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    /// For Settings::jobs. The team must outlive the context.
    [[nodiscard]] JobSystem jobs();

private:
    using Job = void (*)(void* data, std::uint32_t number);

    void run(std::uint32_t jobs, Job job, void* data);
    void work();
    /// Runs jobs until none is left.
    void take_jobs();

    std::vector<std::thread> threads_;  // all but the calling thread
    std::mutex mutex_;
    std::condition_variable begun_;
    std::condition_variable ended_;
    std::uint64_t round_ = 0;  // how many times jobs were started
    std::uint32_t working_ = 0;
    bool over_ = false;
    // The current set of jobs; read by the threads that run them.
    Job job_ = nullptr;
    void* data_ = nullptr;
    std::uint32_t count_ = 0;
    std::atomic<std::uint32_t> next_ = 0;
};

}  // namespace nearfield::tools
