#pragma once

#include <engine/base/jobs.hpp>
#include <engine/results/query_answers.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield::results {

/// Writes the results of a batch, in several threads if the host provides a job system. The
/// assignment of queries to jobs depends only on the batch and the number of jobs, so a batch like
/// the one before finds all its memory allocated, whichever threads run the jobs. Serves one batch
/// after the other.
class AnswerJobs {
public:
    explicit AnswerJobs(const JobSystem& jobs);

    /// Writes the results of the queries that the CPU answers; returns their number. Rethrows the
    /// exception of a job, the first job's if several threw. See QueryAnswers::write().
    std::size_t answer_on_cpu(const plan::Plan& plan, DeviceAnswers& device,
                              decode::FieldDecoder& fields, std::vector<AnyResult>& results);
    /// Writes the results of the other queries, in the calling thread.
    void finish(const plan::Plan& plan, DeviceAnswers& device, decode::FieldDecoder& fields,
                std::vector<AnyResult>& results);

private:
    /// One job of a batch and its outcome.
    struct Job {
        QueryAnswers answers;
        std::size_t answered = 0;
    };
    /// The input and output shared by all jobs of a batch.
    struct Work {
        const plan::Plan& plan;
        DeviceAnswers& device;
        decode::FieldDecoder& fields;
        std::vector<AnyResult>& results;
    };

    void divide(const plan::Plan& plan, std::size_t queries);
    /// Runs every `step`-th part, starting at `first_part`.
    void run(Job& job, std::size_t first_part, std::size_t step, const Work& work) const;
    std::size_t run_at_once(std::uint32_t jobs, const Work& work);

    Jobs jobs_;
    std::vector<std::unique_ptr<Job>> answers_;  // one per job
    std::vector<std::size_t> ends_;              // of the parts of a batch, by query
};

}  // namespace nearfield::results
