#pragma once

#include <engine/query_answers.hpp>
#include <nearfield/jobs.hpp>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

/// Writes the results of a batch, where the host lends threads by several at once. Which query is
/// in which job depends on the batch and the number of jobs alone, so a batch like the one before
/// finds all memory there, whoever does the jobs. Serves one batch after the other.
class AnswerJobs {
public:
    explicit AnswerJobs(const JobSystem& jobs);

    /// Writes the results of the queries that the CPU answers. Throws what a job threw, of several
    /// what the first of them did. See QueryAnswers::write(). Returns how many there were.
    std::size_t answer_on_cpu(const plan::Plan& plan, std::span<std::uint32_t> words,
                              FieldDecoder& fields, std::vector<AnyResult>& results);
    /// Writes the results of the others, in the thread that calls.
    void finish(const plan::Plan& plan, std::span<std::uint32_t> words, FieldDecoder& fields,
                std::vector<AnyResult>& results);

private:
    /// One job of a batch, and what it leaves.
    struct Job {
        QueryAnswers answers;
        std::size_t answered = 0;
        std::exception_ptr failure;
        bool done = false;
    };
    /// What all jobs of a batch work on.
    struct Work {
        const plan::Plan& plan;
        std::span<std::uint32_t> words;
        FieldDecoder& fields;
        std::vector<AnyResult>& results;
    };

    void divide(const plan::Plan& plan, std::size_t queries);
    /// Every so many parts from one on.
    void run(Job& job, std::size_t first_part, std::size_t step, const Work& work) const;
    std::size_t run_at_once(std::uint32_t jobs, const Work& work);

    JobSystem system_;
    std::vector<std::unique_ptr<Job>> jobs_;  // at least one, for who has no system
    std::vector<std::size_t> ends_;           // of the parts of a batch, by query
};

}  // namespace nearfield
