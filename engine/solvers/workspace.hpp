#pragma once

#include <engine/plan/checked_query.hpp>
#include <engine/plan/memory_budget.hpp>
#include <engine/plan/plan_limits.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <engine/simd/transformed_edges.hpp>

namespace nearfield::solvers {

/// What the solvers of one thread share. `instances` and `simplified` hold what was made of shapes
/// for the queries of a batch so far.
struct Workspace {
    plan::PlanLimits limits;
    simd::TransformedInstances instances;
    plan::SimplifiedShapes simplified;
    plan::MemoryBudget* memory = nullptr;  ///< of the batch

    [[nodiscard]] plan::QueryMemory memory_of(const plan::CheckedQuery& query,
                                              double tolerance) const {
        return {*memory, query.index, tolerance};
    }
};

}  // namespace nearfield::solvers
