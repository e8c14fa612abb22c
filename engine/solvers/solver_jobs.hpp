#pragma once

#include <engine/base/jobs.hpp>
#include <engine/solvers/solvers.hpp>
#include <nearfield/timings.hpp>

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

private:
    void divide(std::span<const queries::CheckedQuery> queries);

    queries::QueryLimits limits_;
    Jobs jobs_;
    std::vector<std::unique_ptr<Solvers>> solvers_;  // one per job
    std::vector<std::size_t> ends_;                  // of the parts of a batch, by query
};

}  // namespace nearfield::solvers
