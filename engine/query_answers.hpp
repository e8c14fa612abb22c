#pragma once

#include <engine/closest.hpp>
#include <engine/contacts.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/exact_field.hpp>
#include <engine/exact_overlap.hpp>
#include <engine/exact_points.hpp>
#include <engine/field_results.hpp>
#include <engine/intersection_test.hpp>
#include <engine/plan/plan.hpp>
#include <engine/point_contacts.hpp>
#include <engine/point_penetration.hpp>
#include <engine/point_resolver.hpp>
#include <engine/separation_vector.hpp>
#include <engine/time_of_impact.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// Writes results of queries, one after the other: all of those that the CPU answers, and of the
/// others what is left once the device has said its part. For one thread at a time; several of
/// these may work on one batch at the same time, each on queries of its own. Keeps its memory from
/// batch to batch.
class QueryAnswers {
public:
    /// Forgets all shapes: they may have moved or deformed since.
    void begin_batch();

    /// Writes the results of some queries of the batch: of those from `first` on and before `end`
    /// that the CPU answers, or of the others there. `words`: by point of the plan, what the device
    /// said; of what the CPU answers they are written here. The field decoder is told how far a
    /// field reaches. Returns how many there were.
    std::size_t write(const plan::Plan& plan, std::size_t first, std::size_t end, bool on_cpu,
                      std::span<std::uint32_t> words, FieldDecoder& fields,
                      std::vector<AnyResult>& results);

private:
    /// A query, and what its answer is made of.
    struct Asked {
        const plan::Plan& plan;
        std::uint32_t query;
        std::span<std::uint32_t> words;
        FieldDecoder& fields;

        [[nodiscard]] const plan::PlannedQuery& planned() const { return plan.queries[query]; }
    };

    /// Whether the shapes of a query share a point.
    [[nodiscard]] bool shapes_intersect(const Asked& asked, ResultSummary& result);
    void find_points(const Asked& asked);
    void answer(const Asked& asked, PenetrationResult& result);
    void answer(const Asked& asked, IntersectionResult& result);
    void answer(const Asked& asked, DistanceFieldResult& result);
    void answer(const Asked& asked, ContactResult& result);
    void answer(const Asked& asked, ClosestPointResult& result);
    void answer(const Asked& asked, SeparationResult& result);
    void answer(const Asked& asked, IntersectionTestResult& result);
    void answer(const Asked& asked, TimeOfImpactResult& result);
    void answer(const Asked& asked, SeparationVectorResult& result);

    exact::PlacedInstances instances_;   // of the batch, as far as they came up
    plan::SimplifiedShapes simplified_;  // likewise
    PointResolver resolver_;
    ContactDecoder contact_decoder_;
    FoundContacts found_contacts_;
    PointContacts contacts_;
    ExactPoints exact_points_;
    ExactField exact_fields_;
    ExactOverlap overlaps_;
    IntersectionTest intersection_test_;
    TimeOfImpact time_of_impact_;
    SeparationVector separation_vector_;
    PointPenetration penetration_;
    ClosestDecoder closest_;
};

}  // namespace nearfield
