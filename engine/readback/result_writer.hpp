#pragma once

#include <engine/narrowphase/overlap_test.hpp>
#include <engine/plan/memory_budget.hpp>
#include <engine/plan/placed_pair.hpp>
#include <engine/plan/plan.hpp>
#include <engine/readback/contacts.hpp>
#include <engine/readback/device_answers.hpp>
#include <engine/readback/point_resolver.hpp>
#include <engine/records/found_contacts.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <engine/solvers/closest_points.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::readback {

/// Makes results of what the device has answered, exact in double precision. For one thread. Serves
/// one batch after the other and keeps its memory.
class ResultWriter {
public:
    /// Writes the results of the queries that a device answers, except for the normals of contacts
    /// that are gradients, and for points that the search had no room for: these are left to the
    /// CPU. Once the call is interrupted, results are empty and say so. Throws StatusException
    /// (too_large) if the points that the search has found exceed the memory of the batch.
    void write(const plan::Plan& plan, std::span<const std::uint32_t> queries,
               DeviceAnswers& answers, plan::MemoryBudget& memory, std::vector<AnyResult>& results);

private:
    /// A query and what its answer is made of.
    struct Input {
        const plan::Plan& plan;
        const plan::PlannedQuery& planned;
        const DeviceAnswers& answers;
        plan::MemoryBudget& memory;
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

    simd::TransformedInstances instances_;  // of the batch, made when first needed; large ones kept
    narrowphase::OverlapTest overlap_test_;
    PointResolver resolver_;
    ContactDecoder contact_decoder_;
    records::FoundContacts found_contacts_;
    solvers::ClosestSolver closest_;
    /// Two instances of the batch: pairs are often asked about in both orders.
    struct KnownPair {
        std::uint32_t low = UINT32_MAX;
        std::uint32_t high = UINT32_MAX;
        bool intersects = false;
    };
    std::array<KnownPair, 1024> known_;  // by hash
};

}  // namespace nearfield::readback
