#include <engine/plan/empty_result.hpp>
#include <engine/plan/planner.hpp>

#include <type_traits>
#include <utility>

namespace nearfield::plan {

Planner::Planner(const PlanLimits& limits)
    : limits_(with_affordable_atlas(limits)),
      targets_(limits.offset_alignment),
      points_(limits_),
      packer_(limits_.largest_atlas) {}

void Planner::begin(std::size_t queries, Plan& plan) {
    memory_.emplace(limits_);
    plan.clear();
    targets_.clear();
    plan.queries.resize(queries);
}

void Planner::add(const CheckedQuery& checked, Plan& plan, AnyResult& any) {
    PlannedQuery& planned = plan.queries[checked.index];
    static_cast<CheckedQuery&>(planned) = checked;
    planned.on_device = false;
    planned.work = std::monostate();
    std::visit(
        [&]<class Query>(const Query& query) {
            auto& result = std::get<typename Query::Result>(any);
            CurrentQuery current{limits_, plan, checked.index,
                                 QueryMemory(*memory_, checked.index, result.tolerance)};
            plan_query(query, current, result);
        },
        *checked.query);
}

void Planner::finish(Plan& plan) {
    points_.finish(limits_, plan);
    plan.result_bytes = memory_->result_bytes();
    packer_.pack(plan);
}

template <class Query>
void Planner::plan_query(const Query& query, CurrentQuery& current,
                         typename Query::Result& result) {
    if constexpr (requires { query.on_device; }) {
        current.planned().on_device = query.on_device;
        if (query.on_device) {
            current.plan.resident.push_back(current.index);
        }
    }
    if (Status status = add_target(query, current.index); !status.ok()) {
        result.status = std::move(status);
    } else if constexpr (answered_by_cpu_alone<Query> == nullptr) {
        planner_of(query).plan(query, current, result);
    }
    if (!result.status.ok()) {
        targets_.drop(current.index);
        if constexpr (std::is_same_v<Query, DistanceFieldQuery>) {
            clear_cells(result);
        }
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

}  // namespace nearfield::plan
