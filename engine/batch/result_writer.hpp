#pragma once

#include <engine/batch/contacts.hpp>
#include <engine/batch/device_answers.hpp>
#include <engine/batch/point_resolver.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/queries/memory_budget.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/closest_points.hpp>
#include <engine/solvers/found_contacts.hpp>
#include <engine/solvers/gradient_normals.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::batch {

/// Makes results of what the device has answered, exact in double precision. For one thread. Serves
/// one batch after the other and keeps its memory.
class ResultWriter {
public:
    explicit ResultWriter(const queries::QueryLimits& limits) { workspace_.limits = limits; }

    /// Writes the results of the queries that a device answers, except for points that the search
    /// had no room for: these are left to the CPU. Once the call is interrupted, results are empty
    /// and say so. Throws StatusException (too_large) if the points that the search has found
    /// exceed the memory of the batch.
    void write(const device_input::Plan& plan, std::span<const std::uint32_t> queries,
               DeviceAnswers& answers, queries::MemoryBudget& memory,
               std::vector<AnyResult>& results);

private:
    /// A query and what its answer is made of.
    struct Input {
        const device_input::Plan& plan;
        const device_input::PlannedQuery& planned;
        const DeviceAnswers& answers;
        queries::MemoryBudget& memory;
    };

    /// Whether the shapes of a query share a point.
    [[nodiscard]] bool shapes_intersect(const Input& input);
    void write(const Input& input, PenetrationResult& result);
    void write_searched(const Input& input, PenetrationResult& result);
    void list_penetrations(PenetrationResult& result);
    void write(const Input& input, IntersectionResult& result);
    void write(const Input& input, DistanceFieldResult& result);
    void write(const Input& input, ContactResult& result);
    void write(const Input& input, ClosestPointResult& result);
    void write(const Input& input, SeparationResult& result);
    /// For results of queries that the CPU alone answers.
    void write(const Input& /*input*/, ResultSummary& /*result*/) {}

    solvers::Workspace workspace_;
    narrowphase::OverlapTest overlap_test_;
    PointResolver resolver_;
    ContactDecoder contact_decoder_;
    solvers::FoundContacts found_contacts_;
    solvers::GradientNormals normals_;
    solvers::ClosestSolver closest_;
    /// Two instances of the batch: pairs are often asked about in both orders.
    struct KnownPair {
        std::uint32_t low = UINT32_MAX;
        std::uint32_t high = UINT32_MAX;
        bool intersects = false;
    };
    std::vector<KnownPair> known_;  // by hash
};

}  // namespace nearfield::batch
