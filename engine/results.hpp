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
#include <engine/plan/round.hpp>
#include <engine/point_penetration.hpp>
#include <engine/point_resolver.hpp>
#include <engine/separation_vector.hpp>
#include <engine/time_of_impact.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// Decodes what came back from the device, round by round, and makes it exact in double precision.
class ResultDecoder {
public:
    explicit ResultDecoder(const char* gradient_format) : fields_(gradient_format) {}

    void begin_batch(const plan::Plan& plan);

    /// Takes the read-back of one round.
    void add_points(const plan::Round& round, std::span<const std::uint32_t> words);
    static void add_summaries(const plan::Plan& plan, const plan::Round& round,
                              std::span<const plan::TileSummary> summaries,
                              std::vector<AnyResult>& results);
    void add_field(const plan::Plan& plan, const plan::Round& round,
                   std::span<const std::uint32_t> words, std::vector<AnyResult>& results) {
        fields_.add(plan, round, words, results);
    }
    void add_samples(const plan::Plan& plan, const plan::Round& round,
                     std::span<const plan::SampleData> samples);

    /// By point of the plan, what the device said.
    [[nodiscard]] std::span<const std::uint32_t> point_words() const { return words_; }

    /// Writes the results that have no part on the device. Needs nothing of the rounds.
    void answer_on_cpu(const plan::Plan& plan, std::vector<AnyResult>& results);
    /// After the last round: writes the other results, but for contacts whose normals are to be
    /// gradients.
    void finish(const plan::Plan& plan, std::vector<AnyResult>& results);

private:
    struct FoundSample {
        std::uint32_t query = 0;
        std::uint32_t region = 0;
        std::uint64_t row = 0;
        std::uint64_t column = 0;
        IntersectionSample sample;
    };

    /// Whether the shapes of a query share a point.
    [[nodiscard]] bool shapes_intersect(const plan::Plan& plan, const plan::PlannedQuery& query,
                                        ResultSummary& result);
    void finish_penetration(const plan::Plan& plan, const plan::PlannedQuery& planned,
                            PenetrationResult& result);
    /// Of the queries that the CPU answers, or of the others.
    void finish_queries(const plan::Plan& plan, bool on_cpu, std::vector<AnyResult>& results);
    void write_drawn_samples(std::vector<AnyResult>& results);

    PointResolver resolver_;
    ExactField exact_fields_;
    ContactDecoder contacts_;
    std::vector<std::uint32_t> words_;  // by point of the plan
    std::vector<FoundSample> samples_;
    FieldDecoder fields_;
    exact::PlacedInstances instances_;  // of the batch, as far as the CPU alone answers
    ExactPoints exact_points_;
    plan::SimplifiedShapes simplified_;  // of what the CPU answers
    ExactOverlap overlaps_;
    IntersectionTest intersection_test_;
    TimeOfImpact time_of_impact_;
    SeparationVector separation_vector_;
    PointPenetration penetration_;
    ClosestDecoder closest_;
};

}  // namespace nearfield
