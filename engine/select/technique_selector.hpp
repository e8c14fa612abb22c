#pragma once

#include <engine/plan/query_shapes.hpp>
#include <engine/plan/technique.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::select {

/// Selects the technique for each query of a batch: the one the query asks for or, for
/// Technique::automatic, the one that minimises the batch's time by a cost model. A submission is
/// paid once for all queries that use it, so the best choice for one query depends on the others.
class TechniqueSelector {
public:
    /// `largest_range`: bytes of a storage buffer of the device.
    TechniqueSelector(const CostModel& costs, const plan::AvailableTechniques& available,
                      std::uint64_t largest_range)
        : costs_({costs.raster, costs.compute, costs.cpu}),
          available_(available),
          largest_range_(largest_range) {}

    /// Replaces Technique::automatic by the selected technique; `shapes`: of each query. It stays
    /// if no available technique can answer, which the planner rejects. Other queries that will be
    /// rejected get a technique too.
    void choose(std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes);

private:
    /// Techniques as indices into costs_, and sets of them as bits.
    enum : std::uint32_t { raster, compute, cpu, count };
    using Set = std::uint32_t;
    static constexpr Set every_set = 1U << count;

    /// By device (raster and compute): the microseconds that it may save over the CPU.
    using Savings = std::array<double, cpu>;

    /// A query with Technique::automatic.
    struct Candidate {
        AnyQuery* query = nullptr;
        plan::QueryShapes shapes;
        /// Upper bound, computed without reading a vertex.
        Savings max_saved{};
        /// Time by each technique that can answer, infinite for the others. Set by estimate().
        std::array<double, count> times{};
    };

    /// Collects the queries with Technique::automatic. Returns the techniques that others ask for.
    [[nodiscard]] Set add_candidates(std::span<AnyQuery> queries,
                                     std::span<const plan::QueryShapes> shapes);
    void add_candidate(AnyQuery& query, const plan::QueryShapes& shapes);
    void estimate(Candidate& candidate) const;
    /// True if the CPU alone takes the least time. Estimates candidates only until that is decided;
    /// if false, all are estimated.
    [[nodiscard]] bool cpu_is_best(Set paid);
    /// The techniques to allow for the batch to take the least time.
    [[nodiscard]] Set best_set(Set paid) const;
    /// Microseconds of a technique's submission, 0 if it is already paid.
    [[nodiscard]] double submission(std::uint32_t technique, Set paid) const {
        return (paid >> technique & 1U) != 0 ? 0.0 : costs_[technique].submission;
    }
    [[nodiscard]] static std::uint32_t fastest(const Candidate& candidate, Set allowed);
    /// Microseconds that all candidates take if only the `allowed` techniques are used, and `paid`
    /// ones are submitted anyway.
    [[nodiscard]] double time_by(Set allowed, Set paid) const;

    /// Whether a technique is available and can answer.
    [[nodiscard]] bool can_answer(Technique technique, const AnyQuery& query) const {
        return available_.has(technique) && plan::answers(technique, query);
    }
    [[nodiscard]] bool is_answered_by_any(const AnyQuery& query) const;

    std::array<TechniqueCost, count> costs_;
    plan::AvailableTechniques available_;
    std::uint64_t largest_range_;
    std::vector<Candidate> candidates_;
};

}  // namespace nearfield::select
