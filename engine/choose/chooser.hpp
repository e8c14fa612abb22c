#pragma once

#include <engine/plan/query_shapes.hpp>
#include <engine/plan/technique.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::choose {

/// Picks what answers each query of a batch: as the query says, or, for Technique::automatic, what
/// makes the batch take the least time by a cost model. A submission is paid once however many
/// queries use it, so what is best for one query depends on the others.
class Chooser {
public:
    Chooser(const CostModel& costs, const plan::AvailableTechniques& available)
        : costs_({costs.raster, costs.compute, costs.cpu}), available_(available) {}

    /// Replaces Technique::automatic by what was picked; `shapes`: of each query. It stays where no
    /// technique that is there has an answer, which the planner refuses. Another query that will be
    /// refused gets a technique too.
    void choose(std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes);

private:
    /// Techniques as positions of costs_, and sets of them as bits.
    enum : std::uint32_t { raster, compute, cpu, count };
    using Set = std::uint32_t;
    static constexpr Set every_set = 1U << count;

    /// By device, that is raster and compute: microseconds that it may take less than the CPU.
    using Savings = std::array<double, cpu>;

    /// A query that leaves the technique open.
    struct Candidate {
        AnyQuery* query = nullptr;
        plan::QueryShapes shapes;
        /// No more than this, as far as can be told without a look at a vertex.
        Savings most_saved{};
        /// What it takes by each technique that has an answer, infinite for the others. Not known
        /// before estimate().
        std::array<double, count> times{};
    };

    /// Notes the queries that leave the technique open. Returns the techniques that others ask for.
    [[nodiscard]] Set add_candidates(std::span<AnyQuery> queries,
                                     std::span<const plan::QueryShapes> shapes);
    void add_candidate(AnyQuery& query, const plan::QueryShapes& shapes);
    void estimate(Candidate& candidate) const;
    /// True where the CPU alone takes the least time. Estimates candidates only until that is
    /// settled; where it is false all are.
    [[nodiscard]] bool cpu_is_best(Set paid);
    /// The techniques that may be used for the batch to take the least time.
    [[nodiscard]] Set best_set(Set paid) const;
    /// Microseconds of a technique's submission, where it is not paid.
    [[nodiscard]] double submission(std::uint32_t technique, Set paid) const {
        return (paid >> technique & 1U) != 0 ? 0.0 : costs_[technique].submission;
    }
    [[nodiscard]] static std::uint32_t fastest(const Candidate& candidate, Set allowed);
    /// Microseconds that all candidates take where only these techniques may be used, and `paid`
    /// ones are used anyway.
    [[nodiscard]] double time_by(Set allowed, Set paid) const;

    /// Whether a technique is there and has an answer.
    [[nodiscard]] bool can_answer(Technique technique, const AnyQuery& query) const {
        return available_.has(technique) && plan::answers(technique, query);
    }
    [[nodiscard]] bool is_answered_by_any(const AnyQuery& query) const;

    std::array<TechniqueCost, count> costs_;
    plan::AvailableTechniques available_;
    std::vector<Candidate> candidates_;
};

}  // namespace nearfield::choose
