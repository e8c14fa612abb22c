#pragma once

#include <engine/solvers/closest_points.hpp>
#include <engine/solvers/contacts.hpp>
#include <engine/solvers/containment.hpp>
#include <engine/solvers/field.hpp>
#include <engine/solvers/intersection_test.hpp>
#include <engine/solvers/overlap_samples.hpp>
#include <engine/solvers/penetration.hpp>
#include <engine/solvers/separation_vector.hpp>
#include <engine/solvers/time_of_impact.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// The functions `answer(query, workspace, result)` of all solvers.
template <class... Solver>
struct SolverOfEachKind : Solver... {
    using Solver::answer...;
};

/// Answers queries on the CPU, one after the other: the solver of each kind of query. For one
/// thread. Keeps its memory from batch to batch.
class Solvers {
public:
    explicit Solvers(const queries::QueryLimits& limits) { workspace_.limits = limits; }

    /// Forgets all shapes, which may have moved or deformed since; large ones that did not are
    /// kept. `memory`: what results may take; it must stay. Precondition: polygons of different
    /// batches have different addresses or revisions.
    void begin_batch(queries::MemoryBudget& memory);

    /// Writes the result of a query; an error of this query alone is stated there. Throws
    /// StatusException (too_large) if the batch needs more memory than the limit.
    void answer(const queries::CheckedQuery& query, AnyResult& any);

private:
    Workspace workspace_;
    SolverOfEachKind<PenetrationSolver, ContactSolver, OverlapSolver, FieldSolver, ClosestSolver,
                     IntersectionTestSolver, TimeOfImpactSolver, SeparationVectorSolver,
                     ContainmentSolver>
        solvers_;
};

}  // namespace nearfield::solvers
