#pragma once

#include <engine/base/jobs.hpp>
#include <engine/solvers/solvers.hpp>
#include <nearfield/timings.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Answers the queries of a batch on the CPU, in several threads if the host provides a job system.
/// The assignment of queries to jobs depends only on the batch and the number of jobs, so a batch
/// like the one before finds all its memory allocated, whichever threads run the jobs. Serves one
/// batch after the other.
class SolverJobs {
public:
    SolverJobs(const queries::QueryLimits& limits, const JobSystem& jobs);

    /// Writes the results of checked queries of a batch. `results` and `times`: of the whole batch;
    /// no times if nobody asked for them. `other_bytes`: what the results of its other queries may
    /// need. Once the call is interrupted, results are empty and say so. Rethrows the exception of
    /// a job, the first job's if several threw: StatusException (too_large) if the batch needs more
    /// memory than the limit.
    void answer(std::span<const queries::CheckedQuery> queries, double other_bytes,
                std::span<QueryTime> times, std::vector<AnyResult>& results);

    /// A query of technique `cpu` that is asked and answered while others are.
    struct Question {
        AnyQuery query;
        queries::QueryShapes shapes;
        AnyResult result;
    };
    /// Answers `count` queries without a batch: calls `ask(i, question)`, which writes query and
    /// shapes, and then `take(job, i, result)`. `questions`: memory, one by job. Throws as
    /// answer(), and what interrupts the call.
    template <class Ask, class Take>
    void answer_each(std::size_t count, std::span<Question> questions, const Ask& ask,
                     const Take& take) {
        constexpr std::size_t at_once = 4096;
        for (std::size_t block = 0; block < count; block += at_once) {
            queries::MemoryBudget memory(limits_);
            const std::size_t size = std::min(at_once, count - block);
            begin_batch(size, memory);
            jobs_.divide(size, questions_of_a_part,
                         [&](std::uint32_t job, std::size_t first, std::size_t end) {
                             for (std::size_t i = first; i < end; ++i) {
                                 Question& question = questions[job];
                                 ask(block + i, question);
                                 answer(job, question);
                                 take(job, block + i, question.result);
                             }
                         });
        }
    }
    [[nodiscard]] std::uint32_t jobs() const { return jobs_.count(); }

private:
    static constexpr std::size_t questions_of_a_part = 128;

    void begin_batch(std::size_t questions, queries::MemoryBudget& memory);
    void answer(std::uint32_t job, Question& question);
    void divide(std::span<const queries::CheckedQuery> queries);

    queries::QueryLimits limits_;
    Jobs jobs_;
    std::vector<std::unique_ptr<Solvers>> solvers_;  // one per job
    std::vector<std::size_t> ends_;                  // of the parts of a batch, by query
};

}  // namespace nearfield::solvers
