#pragma once

#include <engine/cpu/closest.hpp>
#include <engine/cpu/containment.hpp>
#include <engine/cpu/exact_field.hpp>
#include <engine/cpu/exact_overlap.hpp>
#include <engine/cpu/exact_points.hpp>
#include <engine/cpu/intersection_test.hpp>
#include <engine/cpu/point_contacts.hpp>
#include <engine/cpu/point_penetration.hpp>
#include <engine/cpu/separation_vector.hpp>
#include <engine/cpu/time_of_impact.hpp>
#include <engine/decode/contacts.hpp>
#include <engine/decode/field_results.hpp>
#include <engine/decode/found_pairs.hpp>
#include <engine/plan/plan.hpp>
#include <engine/records/point_resolver.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::results {

/// What the device has answered.
struct DeviceAnswers {
    std::vector<std::uint32_t> words;  ///< by point of the plan
    decode::FoundPairs pairs;

    /// The points of a planned query.
    [[nodiscard]] records::QueryPoints points_of(const plan::Plan& plan, std::uint32_t query) const;
};

/// Writes results of queries, one after the other: those that the CPU answers, and the CPU's part
/// of the others once the device's results are in. For one thread at a time; several instances may
/// work on one batch at the same time, each on queries of its own. Keeps its memory from batch to
/// batch.
class QueryAnswers {
public:
    /// Forgets all shapes, which may have moved or deformed since; large ones that did not are
    /// kept. Precondition: polygons of different batches have different addresses or revisions.
    void begin_batch();

    /// Writes the results of the queries of the batch from `first` up to, but without, `end`:
    /// either those that the CPU answers or the others; returns their number. Words of points of
    /// queries that the CPU answers are written to those of the device. Passes the largest field
    /// value to the field decoder. Once the call is interrupted, results are empty and say so.
    std::size_t write(const plan::Plan& plan, std::size_t first, std::size_t end, bool on_cpu,
                      DeviceAnswers& device, decode::FieldDecoder& fields,
                      std::vector<AnyResult>& results);

private:
    /// A query and the inputs of its answer.
    struct Asked {
        const plan::Plan& plan;
        std::uint32_t query;
        DeviceAnswers& device;
        decode::FieldDecoder& fields;

        [[nodiscard]] const plan::PlannedQuery& planned() const { return plan.queries[query]; }
    };

    void write(const Asked& asked, bool on_cpu, AnyResult& any);
    /// Returns whether the shapes of a query share a point.
    [[nodiscard]] bool shapes_intersect(const Asked& asked, ResultSummary& result);
    void find_points(const Asked& asked);
    void answer(const Asked& asked, PenetrationResult& result);
    void answer_by_search(const Asked& asked, PenetrationResult& result);
    void take_summary(const records::PenetrationSummary& summary, PenetrationResult& result);
    void list_penetrations(PenetrationResult& result);
    void answer(const Asked& asked, IntersectionResult& result);
    void answer(const Asked& asked, DistanceFieldResult& result);
    void answer(const Asked& asked, ContactResult& result);
    void answer(const Asked& asked, ClosestPointResult& result);
    void answer(const Asked& asked, SeparationResult& result);
    void answer(const Asked& asked, IntersectionTestResult& result);
    void answer(const Asked& asked, TimeOfImpactResult& result);
    void answer(const Asked& asked, SeparationVectorResult& result);
    void answer(const Asked& asked, ContainmentResult& result);

    simd::TransformedInstances instances_;  // of the batch, made when first needed; large ones kept
    plan::SimplifiedShapes simplified_;     // likewise
    records::PointResolver resolver_;
    decode::ContactDecoder contact_decoder_;
    records::FoundContacts found_contacts_;
    cpu::PointContacts contacts_;
    cpu::ExactPoints exact_points_;
    cpu::ExactField exact_fields_;
    cpu::ExactOverlap overlaps_;
    cpu::IntersectionTest intersection_test_;
    cpu::TimeOfImpact time_of_impact_;
    cpu::SeparationVector separation_vector_;
    cpu::Containment containment_;
    cpu::PointPenetration penetration_;
    cpu::ClosestDecoder closest_;
    // The last penetration query of the batch whose points the device has found, and whether its
    // shapes intersect: so do they the other way round.
    const plan::PlannedQuery* searched_ = nullptr;
    bool searched_intersect_ = false;
};

}  // namespace nearfield::results
