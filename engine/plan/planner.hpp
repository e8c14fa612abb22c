#pragma once

#include <engine/plan/check_target.hpp>
#include <engine/plan/field_planner.hpp>
#include <engine/plan/memory_budget.hpp>
#include <engine/plan/overlap_planner.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/plan_limits.hpp>
#include <engine/plan/point_planner.hpp>
#include <engine/plan/query_shapes.hpp>
#include <engine/plan/tile_packer.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::plan {

/// How many submissions a batch may take.
enum class Submissions {
    any,  ///< further ones where the results of the first require it
    one,  ///< queries that need more are rejected
};

/// Turns queries into tiles: checks each query, has it planned by the planner of its kind, and
/// packs all tiles of the batch. Keeps its scratch memory from batch to batch.
class Planner {
public:
    explicit Planner(const PlanLimits& limits);

    /// Fills `plan` and, in `results`, everything known before rendering: status, bounds, regions.
    /// An error in one query is stored in its result and leaves it without tiles. A query that
    /// still has Technique::automatic is one that no technique of this context answers. `shapes`:
    /// of each query. `submissions`: how many the batch may take. Throws StatusException
    /// (too_large) if the batch needs more memory than the limit.
    void plan(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes, Plan& plan,
              std::vector<AnyResult>& results, Submissions submissions = Submissions::any);

    /// In place of plan(), where the call ends before: nothing is planned, and all results are
    /// empty and have this status.
    static void plan_nothing(std::span<const AnyQuery> queries, const Status& status, Plan& plan,
                             std::vector<AnyResult>& results);

private:
    void plan_all(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes,
                  Submissions submissions, MemoryBudget& memory, Plan& plan,
                  std::vector<AnyResult>& results);
    /// Plans a query, or states in its result why it is rejected.
    template <class Query>
    void plan_query(const Query& query, const QueryShapes& shapes, Submissions submissions,
                    CurrentQuery& current, typename Query::Result& result);
    /// Returns success or the first reason to reject a query whose shapes are known.
    template <class Query>
    [[nodiscard]] Status check(const Query& query, Submissions submissions,
                               const CurrentQuery& current);

    PlanLimits limits_;
    Targets targets_;  // of the batch
    PointPlanner points_;
    FieldPlanner fields_;
    OverlapPlanner overlaps_;
    TilePacker packer_;
};

}  // namespace nearfield::plan
