#include <engine/base/interruption.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/empty_result.hpp>
#include <engine/plan/planner.hpp>
#include <engine/plan/query_timer.hpp>

#include <type_traits>
#include <utility>

namespace nearfield::plan {
namespace {

/// Only the box of a distance field's A is used.
template <class Query>
constexpr bool is_of_b_alone = std::is_same_v<Query, DistanceFieldQuery>;

}  // namespace

Planner::Planner(const PlanLimits& limits)
    : limits_(with_affordable_atlas(limits)),
      targets_(limits.offset_alignment),
      points_(limits_),
      packer_(limits_.largest_atlas) {}

void Planner::plan(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes,
                   Plan& plan, std::vector<AnyResult>& results, Submissions submissions) {
    MemoryBudget memory(limits_, false);
    plan_all(queries, shapes, submissions, memory, plan, results);
    if (memory.is_exceeded()) {
        memory = MemoryBudget(limits_, true);
        plan_all(queries, shapes, submissions, memory, plan, results);
    }
    packer_.pack(plan);
    plan.result_bytes = memory.result_bytes();
    plan.max_jobs = memory.jobs_with_room();
}

void Planner::plan_nothing(std::span<const AnyQuery> queries, const Status& status, Plan& plan,
                           std::vector<AnyResult>& results) {
    plan.clear();
    plan.queries.assign(queries.size(), {});
    results.resize(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
        std::visit(
            [&](const auto& query) {
                using Result = typename std::decay_t<decltype(query)>::Result;
                make_empty<Result>(results[i]).status = status;
            },
            queries[i]);
    }
}

void Planner::plan_all(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes,
                       Submissions submissions, MemoryBudget& memory, Plan& plan,
                       std::vector<AnyResult>& results) {
    plan.clear();
    targets_.clear();
    plan.bounding_volume = limits_.bounding_volume;
    results.resize(queries.size());
    plan.queries.resize(queries.size());
    for (std::uint32_t i = 0; i < queries.size(); ++i) {
        checkpoint();
        const QueryTimer timer(plan.times, i, &QueryTime::plan);
        plan.queries[i] = {};
        plan.queries[i].query = &queries[i];
        std::visit(
            [&](const auto& query) {
                using Result = typename std::decay_t<decltype(query)>::Result;
                auto& result = make_empty<Result>(results[i], true);
                if constexpr (requires { query.tolerance; }) {
                    result.tolerance = query.tolerance;
                }
                CurrentQuery current{limits_, plan, i, QueryMemory(memory, i, result.tolerance)};
                plan_query(query, shapes[i], submissions, current, result);
            },
            queries[i]);
    }
}

template <class Query>
void Planner::plan_query(const Query& query, const QueryShapes& shapes, Submissions submissions,
                         CurrentQuery& current, typename Query::Result& result) {
    PlannedQuery& planned = current.planned();
    result.technique = query.technique;
    planned.technique = query.technique;
    if constexpr (requires { query.on_device; }) {
        planned.on_device = query.on_device;
        if (query.on_device) {
            current.plan.resident.push_back(current.index);
        }
    }
    planned.a = shapes.a;
    planned.b = shapes.b;
    planned.pose_a = query.a.pose;
    planned.pose_b = query.b.pose;
    // Success is not copied: thousands of queries have it in common.
    if (Status status = check(query, submissions, current); !status.ok()) {
        result.status = std::move(status);
    } else {
        planned.deviations = {is_of_b_alone<Query> ? 0.0 : planned.a->deviation(),
                              planned.b->deviation()};
        if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
            fields_.plan(query, current, result);
        } else if constexpr (std::is_same_v<Query, IntersectionQuery>) {
            overlaps_.plan(query, current, result);
        } else if constexpr (answered_by_cpu_alone<Query> == nullptr) {
            points_.plan(query, current, result);
        }
    }
    if (!result.status.ok()) {
        targets_.drop(current.index);
        if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
            clear_cells(result);
        }
    }
}

template <class Query>
Status Planner::check(const Query& query, Submissions submissions, const CurrentQuery& current) {
    const PlannedQuery& planned = current.planned();
    if (Status status = check_query(query, limits_.techniques); !status.ok()) {
        return status;
    }
    if (submissions == Submissions::one && takes_a_second_submission(query)) {
        return not_recordable(query.technique);
    }
    const bool a_left_out = is_of_b_alone<Query> && query.a.shape == ShapeHandle{};
    if (planned.a == nullptr && !a_left_out) {
        return limits_.shape_errors->unknown("shape A", query.a.shape);
    }
    if (planned.b == nullptr) {
        return limits_.shape_errors->unknown("shape B", query.b.shape);
    }
    if constexpr (requires { query.target; }) {
        if (query.on_device && query.target != nullptr) {
            if constexpr (requires { query.features_on_device; }) {
                return targets_.add(*query.target, query.features_on_device, current.index);
            } else {
                return targets_.add(*query.target, current.index);
            }
        }
    }
    return {};
}

}  // namespace nearfield::plan
