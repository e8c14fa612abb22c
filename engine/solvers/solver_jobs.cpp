#include <engine/base/interruption.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/queries/empty_result.hpp>
#include <engine/queries/query_timer.hpp>
#include <engine/solvers/solver_jobs.hpp>

#include <algorithm>
#include <variant>

namespace nearfield::solvers {
namespace {

using queries::CheckedQuery;

/// About ten microseconds of work: a smaller part is not worth a job.
constexpr std::size_t edges_of_a_part = 1024;

/// Cost of a query, in edges or samples that are visited once or twice.
std::size_t weight_of(const CheckedQuery& query) {
    const std::size_t edges = (query.a == nullptr ? 0 : query.a->size()) + query.b->size();
    if (const auto* const penetration = std::get_if<PenetrationQuery>(query.query)) {
        return penetration->points == PenetrationPoints::vertices
                   ? edges
                   : edges + static_cast<std::size_t>(queries::max_points(query));
    }
    if (std::holds_alternative<ContactQuery>(*query.query)) {
        return edges + static_cast<std::size_t>(queries::max_samples(*query.a, query.budget.cell) +
                                                queries::max_samples(*query.b, query.budget.cell));
    }
    const bool looks_once = std::holds_alternative<IntersectionTestQuery>(*query.query) ||
                            std::holds_alternative<ContainmentQuery>(*query.query) ||
                            std::holds_alternative<SeparationQuery>(*query.query) ||
                            std::holds_alternative<ClosestPointQuery>(*query.query);
    return looks_once ? edges : edges_of_a_part;
}

}  // namespace

SolverJobs::SolverJobs(const queries::QueryLimits& limits, const JobSystem& jobs)
    : limits_(limits), jobs_(jobs) {
    for (std::uint32_t i = 0; i < jobs_.count(); ++i) {
        solvers_.push_back(std::make_unique<Solvers>(limits_));
    }
}

/// Divides the batch into parts large enough for a job. Depends only on the batch.
void SolverJobs::divide(std::span<const CheckedQuery> queries) {
    ends_.clear();
    std::size_t weight = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        weight += weight_of(queries[i]);
        // The solver of a pair knows half of the answer the other way round.
        const bool goes_on =
            i + 1 < queries.size() && queries::is_reverse(queries[i], queries[i + 1]);
        if (weight >= edges_of_a_part && !goes_on) {
            ends_.push_back(i + 1);
            weight = 0;
        }
    }
    if (weight > 0) {
        ends_.push_back(queries.size());
    }
}

void SolverJobs::answer(std::span<const CheckedQuery> queries, double other_bytes,
                        std::span<QueryTime> times, std::vector<AnyResult>& results) {
    if (queries.empty()) {
        return;
    }
    queries::MemoryBudget memory(limits_);
    memory.add(other_bytes);
    ends_.assign(1, queries.size());
    if (jobs_.count() > 1) {
        divide(queries);
    }
    const auto jobs =
        static_cast<std::uint32_t>(std::min<std::size_t>(ends_.size(), jobs_.count()));
    jobs_.run(jobs, [&](std::uint32_t number) {
        Solvers& solvers = *solvers_[number];
        solvers.begin_batch(memory);
        for (std::size_t part = number; part < ends_.size(); part += jobs) {
            for (std::size_t i = part == 0 ? 0 : ends_[part - 1]; i < ends_[part]; ++i) {
                AnyResult& result = results[queries[i].index];
                const queries::QueryTimer timer(times, queries[i].index, &QueryTime::answer);
                try {
                    solvers.answer(queries[i], result);
                } catch (const Interrupted& interrupted) {
                    queries::cut_short(interrupted.status(), result);
                }
            }
        }
    });
}

void SolverJobs::begin_batch(std::size_t questions, queries::MemoryBudget& memory) {
    const std::size_t parts = (questions + questions_of_a_part - 1) / questions_of_a_part;
    for (std::size_t job = 0; job < std::min(parts, solvers_.size()); ++job) {
        solvers_[job]->begin_batch(memory);
    }
}

void SolverJobs::answer(std::uint32_t job, Question& question) {
    queries::CheckedQuery checked;
    if (queries::check(0, question.query, question.shapes, limits_, checked, question.result)) {
        solvers_[job]->answer(checked, question.result);
    }
}

}  // namespace nearfield::solvers
