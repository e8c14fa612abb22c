#pragma once

#include <engine/answer_jobs.hpp>
#include <engine/field_results.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/round.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// Decodes what came back from the device, round by round, and makes it exact in double precision.
class ResultDecoder {
public:
    /// The jobs are shared with other decoders and must outlive this one.
    ResultDecoder(const char* gradient_format, AnswerJobs& answers)
        : answers_(&answers), fields_(gradient_format) {}

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

    void write_drawn_samples(std::vector<AnyResult>& results);

    AnswerJobs* answers_;
    std::size_t left_ = 0;              // queries of the batch that the CPU did not answer
    std::vector<std::uint32_t> words_;  // by point of the plan
    std::vector<FoundSample> samples_;
    FieldDecoder fields_;
};

}  // namespace nearfield
