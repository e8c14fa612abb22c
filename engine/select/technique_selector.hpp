#pragma once

#include <engine/plan/query_shapes.hpp>
#include <engine/plan/technique.hpp>
#include <engine/select/shape_uses.hpp>
#include <engine/select/work.hpp>
#include <nearfield/cost.hpp>
#include <nearfield/query.hpp>

#include <array>
#include <cstdint>
#include <optional>
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
    /// least time by no more than the choice for one query makes, a 4,096th, and what shapes take
    /// that several techniques prepare; but `cpu` is preferred where it takes up to a 32nd longer,
    /// or a ninth longer than device and CPU together. Of hundreds of queries, those that matter
    /// little are judged by a sample.
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
        Set techniques = 0;  ///< that can answer
        /// Upper bound, computed without reading a vertex.
        Savings max_saved{};
        /// Of its shapes, where they count; set by count_shapes().
        std::array<std::optional<std::uint32_t>, 2> uses{};
        /// By each technique; infinite for those that cannot answer. Set by estimate().
        std::array<Load, count> loads{};
        bool is_estimated = false;
        std::uint32_t chosen = cpu;
        std::uint32_t best = cpu;  ///< of the best set of devices so far

        [[nodiscard]] bool can_use(std::uint32_t technique) const {
            return (techniques >> technique & 1U) != 0;
        }
    };

    /// Collects the queries with Technique::automatic. Returns the techniques that others ask for.
    [[nodiscard]] Set add_candidates(std::span<AnyQuery> queries,
                                     std::span<const plan::QueryShapes> shapes);
    /// Nothing if no technique can answer.
    void add_candidate(AnyQuery& query, const plan::QueryShapes& shapes);
    /// Counts the shapes of all candidates.
    void count_shapes();
    /// Work::shape_edges.
    [[nodiscard]] double shape_edges(const Candidate& candidate) const;
    [[nodiscard]] Load load_of(const Work& work, std::uint32_t technique) const;
    void estimate(Candidate& candidate) const;
    /// What the device saves over the CPU if its work is hidden as far as the model allows.
    [[nodiscard]] double saved(const Candidate& candidate, std::uint32_t device) const;
    /// What each device has to save, to be worth its submission.
    [[nodiscard]] Savings least_savings(Set paid) const;
    /// Whether a device may save that with many queries, and the time of estimating them all.
    /// Estimates those that might save it alone, and a sample of the others.
    [[nodiscard]] bool is_a_close_look_worthwhile(const Savings& least);
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
    /// Sets `chosen` of all candidates to the least weighted time. Returns their load and `fixed`,
    /// as if a shape's preparation were divided among techniques as its queries are.
    [[nodiscard]] Load choose_by(const LoadWeights& weights, Set devices, const Load& fixed);
    /// Sets `chosen` of all candidates to a device, or the CPU where the device cannot answer.
    [[nodiscard]] Load choose_alone(std::uint32_t device, const Load& fixed);
    /// What preparing so many edges of a shape takes.
    [[nodiscard]] Load load_of_shape(const ShapeUse& use, std::uint32_t technique,
                                     double edges) const;
    /// What shapes take beside that because several techniques prepare them, as `chosen` has it.
    [[nodiscard]] Load load_of_repeated_shapes();
    [[nodiscard]] static std::uint32_t fastest(const Candidate& candidate,
                                               const LoadWeights& weights, Set devices);
    /// Of the devices that are not paid for.
    [[nodiscard]] Load submissions(Set devices, Set paid) const;

    /// Those that are available and can answer.
    [[nodiscard]] Set techniques_for(const AnyQuery& query) const;

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
