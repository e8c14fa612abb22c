#pragma once

#include <engine/queries/checked_query.hpp>
#include <engine/queries/memory_budget.hpp>
#include <engine/queries/query_limits.hpp>
#include <engine/queries/simplified_shapes.hpp>
#include <engine/simd/transformed_edges.hpp>

namespace nearfield::solvers {

/// What the solvers of one thread share. `instances` and `simplified` hold what was made of shapes
/// for the queries of a batch so far.
struct Workspace {
    queries::QueryLimits limits;
    simd::TransformedInstances instances;
    queries::SimplifiedShapes simplified;
    queries::MemoryBudget* memory = nullptr;  ///< of the batch

    [[nodiscard]] queries::QueryMemory memory_of(const queries::CheckedQuery& query,
                                                 double tolerance) const {
        return {*memory, query.index, tolerance};
    }
};

}  // namespace nearfield::solvers
