#pragma once

#include <engine/plan/query_shapes.hpp>
#include <engine/plan/technique.hpp>
#include <engine/select/shape_uses.hpp>
#include <engine/select/work.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::select {

/// Selects the technique for each query of a batch: the one the query asks for or, for
/// Technique::automatic, the one that minimises the batch's time by a cost model. A submission is
/// paid once for all queries that use it, and device and CPU work side by side, so the best choice
/// for one query depends on the others.
class TechniqueSelector {
public:
    /// `largest_range`: bytes of a storage buffer of the device.
    TechniqueSelector(const CostModel& costs, const plan::AvailableTechniques& available,
                      std::uint64_t largest_range);

    /// Replaces Technique::automatic by the selected technique; `shapes`: of each query. It stays
    /// if no available technique can answer, which the planner rejects. Other queries that will be
    /// rejected get a technique too.
    ///
    /// By the model, the batch takes no longer than with one technique for all, and exceeds the
    /// least time by no more than the choice for one query makes, and a 4,096th; but `cpu` is
    /// preferred where it takes up to a 32nd longer.
    void choose(std::span<AnyQuery> queries, std::span<const plan::QueryShapes> shapes);

private:
    /// Techniques as indices, devices first, and sets of them as bits.
    enum : std::uint32_t { raster, compute, cpu, count };
    using Set = std::uint32_t;

    /// By device (raster and compute): the microseconds that it may save over the CPU.
    using Savings = std::array<double, cpu>;

    /// A query with Technique::automatic.
    struct Candidate {
        AnyQuery* query = nullptr;
        plan::QueryShapes shapes;
        /// Upper bound, computed without reading a vertex.
        Savings max_saved{};
        double shared_edges = 0.0;  ///< Work::shared_edges
        /// By each technique; infinite for those that cannot answer. Set by estimate().
        std::array<Load, count> loads{};
        std::uint32_t chosen = cpu;
        std::uint32_t best = cpu;  ///< of the best set of devices so far
    };

    /// Collects the queries with Technique::automatic. Returns the techniques that others ask for.
    [[nodiscard]] Set add_candidates(std::span<AnyQuery> queries,
                                     std::span<const plan::QueryShapes> shapes);
    void add_candidate(AnyQuery& query, const plan::QueryShapes& shapes);
    /// Counts the shapes of queries about points with Technique::automatic.
    void count_uses(std::span<const AnyQuery> queries, std::span<const plan::QueryShapes> shapes);
    /// Of a query about points: Work::shared_edges.
    [[nodiscard]] double shared_edges(const plan::QueryShapes& shapes) const;
    [[nodiscard]] Load load_of(const Work& work, std::uint32_t technique) const;
    void estimate(Candidate& candidate) const;
    /// What the device saves over the CPU if its work is hidden as far as the model allows.
    [[nodiscard]] double saved(const Candidate& candidate, std::uint32_t device) const;
    /// The devices without which the batch may take longer. Estimates candidates only until there
    /// are none; otherwise all are estimated.
    [[nodiscard]] Set worthwhile_devices(Set paid);
    /// What queries that ask for a technique take, and the submissions that they pay for.
    [[nodiscard]] Load load_of_others(std::span<const AnyQuery> queries,
                                      std::span<const plan::QueryShapes> shapes, Set others) const;
    /// Sets `best` of all candidates, for the least time with any of the devices.
    void choose_best(Set devices, Set paid, const Load& others);
    /// Sets `chosen` of all candidates, for the least time with these devices, whose submissions
    /// `fixed` includes. Returns the load of the batch.
    [[nodiscard]] Load choose_with(Set devices, const Load& fixed);
    /// Sets `chosen` of all candidates to the least weighted time. Returns their load and `fixed`.
    [[nodiscard]] Load choose_by(const LoadWeights& weights, Set devices, const Load& fixed);
    [[nodiscard]] static std::uint32_t fastest(const Candidate& candidate,
                                               const LoadWeights& weights, Set devices);
    /// Of the devices that are not paid for.
    [[nodiscard]] Load submissions(Set devices, Set paid) const;

    /// Whether a technique is available and can answer.
    [[nodiscard]] bool can_answer(Technique technique, const AnyQuery& query) const {
        return available_.has(technique) && plan::answers(technique, query);
    }
    [[nodiscard]] bool is_answered_by_any(const AnyQuery& query) const;

    std::array<DeviceCosts, cpu> devices_;
    CpuCosts cpu_;
    double overlap_;
    QueryCosts by_cpu_;                       ///< all costs
    std::array<QueryCosts, cpu> not_hidden_;  ///< the part of a device's costs
    plan::AvailableTechniques available_;
    std::uint64_t largest_range_;
    std::vector<Candidate> candidates_;
    ShapeUses uses_;
};

}  // namespace nearfield::select
