#include <engine/device_input/planner.hpp>
#include <engine/queries/empty_result.hpp>

#include <type_traits>
#include <utility>

namespace nearfield::device_input {

Planner::Planner(const queries::QueryLimits& limits)
    : limits_(queries::with_affordable_atlas(limits)), targets_(limits.offset_alignment) {}

void Planner::begin(std::size_t queries, Plan& plan) {
    memory_.emplace(limits_);
    plan.clear();
    targets_.clear();
    plan.largest_atlas = limits_.largest_atlas;
    plan.queries.resize(queries);
}

void Planner::add(const queries::CheckedQuery& checked, const PlanDrawnPoints& plan_drawn,
                  Plan& plan, AnyResult& any) {
    PlannedQuery& planned = plan.queries[checked.index];
    static_cast<queries::CheckedQuery&>(planned) = checked;
    planned.on_device = false;
    planned.work = std::monostate();
    std::visit(
        [&]<class Query>(const Query& query) {
            const double tolerance = std::get<typename Query::Result>(any).tolerance;
            CurrentQuery current{limits_, plan, checked.index,
                                 queries::QueryMemory(*memory_, checked.index, tolerance)};
            plan_query(query, plan_drawn, current, any);
        },
        *checked.query);
}

void Planner::finish(Plan& plan) {
    searches_.finish(limits_, plan);
    plan.result_bytes = memory_->result_bytes();
}

template <class Query>
void Planner::plan_query(const Query& query, const PlanDrawnPoints& plan_drawn,
                         CurrentQuery& current, AnyResult& any) {
    auto& result = std::get<typename Query::Result>(any);
    if constexpr (requires { query.on_device; }) {
        current.planned().on_device = query.on_device;
        if (query.on_device) {
            current.plan.resident.push_back(current.index);
        }
    }
    if (Status status = add_target(query, current.index); !status.ok()) {
        result.status = std::move(status);
    } else if constexpr (queries::answered_by_cpu_alone<Query> == nullptr) {
        if constexpr (requires { planner_of(query); }) {
            planner_of(query).plan(query, current, result);
        } else {
            plan_points(query, plan_drawn, current, any);
        }
    }
    if (!result.status.ok()) {
        targets_.drop(current.index);
        if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
            queries::clear_cells(result);
        }
    }
}

template <class Query>
void Planner::plan_points(const Query& query, const PlanDrawnPoints& plan_drawn,
                          CurrentQuery& current, AnyResult& any) {
    if (current.planned().technique == Technique::raster) {
        plan_drawn(current, any);
    } else if constexpr (!queries::is_left_to_cpu_by_compute<Query>) {
        searches_.plan(query, current, std::get<typename Query::Result>(any));
    }
}

template <class Query>
Status Planner::add_target(const Query& query, std::uint32_t index) {
    if constexpr (requires { query.target; }) {
        if (query.on_device && query.target != nullptr) {
            if constexpr (requires { query.features_on_device; }) {
                return targets_.add(*query.target, query.features_on_device, index);
            } else {
                return targets_.add(*query.target, index);
            }
        }
    }
    return {};
}

}  // namespace nearfield::device_input
