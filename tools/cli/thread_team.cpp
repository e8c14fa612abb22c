#include <tools/cli/thread_team.hpp>

#include <algorithm>

namespace nearfield::tools {

ThreadTeam::ThreadTeam(std::uint32_t count) {
    for (std::uint32_t i = 1; i < count; ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

ThreadTeam::~ThreadTeam() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    begun_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

JobSystem ThreadTeam::jobs() {
    const auto threads = static_cast<std::uint32_t>(threads_.size()) + 1;
    // Twice as many jobs as threads even out queries of different cost.
    return {this, std::min(2 * threads, max_jobs),
            [](void* user, std::uint32_t jobs, Job job, void* data) {
                static_cast<ThreadTeam*>(user)->run(jobs, job, data);
            }};
}

void ThreadTeam::run(std::uint32_t jobs, Job job, void* data) {
    {
        const std::lock_guard lock(mutex_);
        job_ = job;
        data_ = data;
        count_ = jobs;
        next_ = 0;
        working_ = static_cast<std::uint32_t>(threads_.size());
        ++round_;
    }
    begun_.notify_all();
    take_jobs();
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return working_ == 0; });
}

void ThreadTeam::take_jobs() {
    for (std::uint32_t number = next_++; number < count_; number = next_++) {
        job_(data_, number);
    }
}

void ThreadTeam::work() {
    std::uint64_t done = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
        begun_.wait(lock, [&] { return over_ || round_ != done; });
        if (over_) {
            return;
        }
        done = round_;
        lock.unlock();
        take_jobs();
        lock.lock();
        if (--working_ == 0) {
            ended_.notify_one();
        }
    }
}

}  // namespace nearfield::tools
