#include <engine/cpu/transformed_pair.hpp>
#include <engine/plan/boundary_points.hpp>
#include <engine/results/answer_jobs.hpp>

#include <algorithm>

namespace nearfield::results {
namespace {

/// About ten microseconds of work: a smaller part is not worth a job.
constexpr std::size_t edges_of_a_part = 1024;

std::size_t edges_of(const plan::PlannedQuery& query) {
    return (query.a == nullptr ? 0 : query.a->size()) + (query.b == nullptr ? 0 : query.b->size());
}

/// Approximate number of samples of a query that is answered by brute force.
std::size_t samples_of(const plan::PlannedQuery& query) {
    const double of_a = plan::max_samples(*query.a, query.budget.cell);
    if (const auto* const penetration = std::get_if<PenetrationQuery>(query.query)) {
        return penetration->points == PenetrationPoints::vertices ? 0
                                                                  : static_cast<std::size_t>(of_a);
    }
    return static_cast<std::size_t>(of_a + plan::max_samples(*query.b, query.budget.cell));
}

/// Cost of a query, in edges or samples that are visited once or twice.
std::size_t weight_of(const plan::PlannedQuery& query) {
    if (query.technique != Technique::cpu) {
        return 0;
    }
    if (query.has_points_of(plan::PointSource::brute_force)) {
        return edges_of(query) + samples_of(query);
    }
    const bool looks_once = std::holds_alternative<IntersectionTestQuery>(*query.query) ||
                            std::holds_alternative<ContainmentQuery>(*query.query) ||
                            std::holds_alternative<SeparationQuery>(*query.query) ||
                            std::holds_alternative<ClosestPointQuery>(*query.query);
    return looks_once ? edges_of(query) : edges_of_a_part;
}

}  // namespace

AnswerJobs::AnswerJobs(const JobSystem& jobs) : jobs_(jobs) {
    for (std::uint32_t i = 0; i < jobs_.count(); ++i) {
        answers_.push_back(std::make_unique<Job>());
    }
}

/// Divides the batch into parts large enough for a job. Depends only on the batch: the start of a
/// part uses nothing from the query before it.
void AnswerJobs::divide(const plan::Plan& plan, std::size_t queries) {
    ends_.clear();
    std::size_t weight = 0;
    for (std::size_t i = 0; i < queries; ++i) {
        weight += weight_of(plan.queries[i]);
        const bool goes_on =
            i + 1 < queries && cpu::is_reverse(plan.queries[i], plan.queries[i + 1]);
        if (weight >= edges_of_a_part && !goes_on) {
            ends_.push_back(i + 1);
            weight = 0;
        }
    }
    if (weight > 0) {
        ends_.push_back(queries);
    }
}

void AnswerJobs::run(Job& job, std::size_t first_part, std::size_t step, const Work& work) const {
    for (std::size_t part = first_part; part < ends_.size(); part += step) {
        const std::size_t first = part == 0 ? 0 : ends_[part - 1];
        job.answered += job.answers.write(work.plan, first, ends_[part], true, work.device,
                                          work.fields, work.results);
    }
}

std::size_t AnswerJobs::run_at_once(std::uint32_t jobs, const Work& work) {
    jobs_.run(jobs, [&](std::uint32_t number) {
        Job& job = *answers_[number];
        job.answers.begin_batch();
        job.answered = 0;
        run(job, number, jobs, work);
    });
    std::size_t answered = 0;
    for (std::uint32_t i = 0; i < jobs; ++i) {
        answered += answers_[i]->answered;
    }
    return answered;
}

std::size_t AnswerJobs::answer_on_cpu(const plan::Plan& plan, DeviceAnswers& device,
                                      decode::FieldDecoder& fields,
                                      std::vector<AnyResult>& results) {
    if (jobs_.count() > 1) {
        divide(plan, results.size());
        const std::uint32_t most = std::min(jobs_.count(), plan.max_jobs);
        const auto jobs = static_cast<std::uint32_t>(std::min<std::size_t>(ends_.size(), most));
        if (jobs > 1) {
            return run_at_once(jobs, {plan, device, fields, results});
        }
    }
    QueryAnswers& answers = answers_.front()->answers;
    answers.begin_batch();
    return answers.write(plan, 0, results.size(), true, device, fields, results);
}

void AnswerJobs::finish(const plan::Plan& plan, DeviceAnswers& device, decode::FieldDecoder& fields,
                        std::vector<AnyResult>& results) {
    // Other batches may have been answered in between.
    QueryAnswers& answers = answers_.front()->answers;
    answers.begin_batch();
    answers.write(plan, 0, results.size(), false, device, fields, results);
}

}  // namespace nearfield::results
