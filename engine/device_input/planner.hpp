#pragma once

#include <engine/device_input/check_target.hpp>
#include <engine/device_input/field_planner.hpp>
#include <engine/device_input/overlap_planner.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/device_input/search_planner.hpp>
#include <engine/queries/checked_query.hpp>
#include <engine/queries/memory_budget.hpp>
#include <engine/queries/query_limits.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace nearfield::device_input {

/// Plans a query about points of technique raster, as PointPlanner of that module does it.
using PlanDrawnPoints = std::function<void(CurrentQuery&, AnyResult&)>;

/// Turns checked queries that a device answers into tiles and searches: has each planned by the
/// planner of its kind. Keeps its scratch memory from batch to batch. Fills a plan and, in results,
/// everything known before rendering: bounds, regions.
class Planner {
public:
    explicit Planner(const queries::QueryLimits& limits);

    /// Begins a batch of so many queries, whoever answers them.
    void begin(std::size_t queries, Plan& plan);
    /// Plans one of them, which has just been checked. An error is stated in its result and leaves
    /// it without tiles. Throws StatusException (too_large) if the batch needs more memory than the
    /// limit.
    void add(const queries::CheckedQuery& checked, const PlanDrawnPoints& plan_drawn, Plan& plan,
             AnyResult& any);
    /// After the last one.
    void finish(Plan& plan);
    /// The shapes that the device searches.
    [[nodiscard]] const SearchShapes& search_shapes() const { return searches_.shapes(); }

private:
    /// Plans a query, or states in its result why it is rejected.
    template <class Query>
    void plan_query(const Query& query, const PlanDrawnPoints& plan_drawn, CurrentQuery& current,
                    AnyResult& any);
    template <class Query>
    void plan_points(const Query& query, const PlanDrawnPoints& plan_drawn, CurrentQuery& current,
                     AnyResult& any);
    /// Adds what the query writes to, if the host names it; returns what is wrong with it.
    template <class Query>
    [[nodiscard]] Status add_target(const Query& query, std::uint32_t index);
    [[nodiscard]] FieldPlanner& planner_of(const DistanceFieldQuery& /*query*/) { return fields_; }
    [[nodiscard]] OverlapPlanner& planner_of(const IntersectionQuery& /*query*/) {
        return overlaps_;
    }

    queries::QueryLimits limits_;
    Targets targets_;  // of the batch, as is the next
    std::optional<queries::MemoryBudget> memory_;
    SearchPlanner searches_;
    FieldPlanner fields_;
    OverlapPlanner overlaps_;
};

}  // namespace nearfield::device_input
