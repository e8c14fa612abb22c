#pragma once

#include <engine/base/function_ref.hpp>
#include <nearfield/jobs.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

namespace nearfield {

/// Runs work on the host's threads, or in the calling thread if there are none. Keeps its memory.
class Jobs {
public:
    explicit Jobs(const JobSystem& system)
        : system_(system),
          outcomes_(system.run == nullptr || system.count == 0 ? 1 : system.count) {}

    /// The maximum number of jobs; at least 1.
    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(outcomes_.size());
    }

    /// Calls `work(job)` for every job below `jobs`, at most count() of them, and returns when all
    /// are done. Rethrows the exception of a job, the first job's if several threw. Throws a
    /// StatusException (invalid_settings) if the host left a job out.
    template <class Work>
    void run(std::uint32_t jobs, const Work& work) {
        if (jobs <= 1) {
            work(0U);
            return;
        }
        run_all(jobs, work);
    }

    /// Divides `count` things into parts of `part` and calls `work(job, first, end)` for each of
    /// them. The assignment of parts to jobs depends on nothing else.
    template <class Work>
    void divide(std::size_t count, std::size_t part, const Work& work) {
        if (count <= part) {
            if (count > 0) {
                work(0U, std::size_t{0}, count);
            }
            return;
        }
        const std::size_t parts = (count + part - 1) / part;
        const auto jobs = static_cast<std::uint32_t>(parts < this->count() ? parts : this->count());
        run(jobs, [&](std::uint32_t job) {
            for (std::size_t i = job; i < parts; i += jobs) {
                const std::size_t first = i * part;
                work(job, first, first + part < count ? first + part : count);
            }
        });
    }

private:
    struct Outcome {
        std::exception_ptr failure;
        bool done = false;
    };

    void run_all(std::uint32_t jobs, FunctionRef<void(std::uint32_t)> work);

    JobSystem system_;
    std::vector<Outcome> outcomes_;  // one per job
};

}  // namespace nearfield
