#pragma once

#include <engine/decode/field_results.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/tile_batch.hpp>
#include <engine/results/answer_jobs.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::results {

/// Decodes the device's results, tile batch by tile batch, and makes them exact in double
/// precision.
class ResultDecoder {
public:
    /// The jobs are shared with other decoders and must outlive this one.
    ResultDecoder(const char* gradient_format, AnswerJobs& answers)
        : answers_(&answers), fields_(gradient_format) {}

    void begin_batch(const plan::Plan& plan);

    /// Decodes the read-back of one tile batch.
    void add_points(const plan::TileBatch& batch, std::span<const std::uint32_t> words);
    /// What a search has found out, which has to stay until finish().
    [[nodiscard]] decode::FoundPairs& pairs() { return device_.pairs; }
    static void add_summaries(const plan::Plan& plan, const plan::TileBatch& batch,
                              std::span<const plan::TileSummary> summaries,
                              std::vector<AnyResult>& results);
    void add_field(const plan::Plan& plan, const plan::TileBatch& batch,
                   std::span<const std::uint32_t> words, std::vector<AnyResult>& results) {
        fields_.add(plan, batch, words, results);
    }
    /// Makes the results of a tile batch's fields errors: the device did not answer all cells.
    void refuse_fields(const plan::Plan& plan, const plan::TileBatch& batch) {
        fields_.refuse(plan, batch);
    }
    void add_samples(const plan::Plan& plan, const plan::TileBatch& batch,
                     std::span<const plan::SampleData> samples);

    /// What the device has answered about points and pairs.
    [[nodiscard]] const DeviceAnswers& device() const { return device_; }

    /// Writes the results of queries without a part on the device. Independent of the tile batches.
    void answer_on_cpu(const plan::Plan& plan, std::vector<AnyResult>& results);
    /// Call after the last tile batch: writes the other results, except for contacts with gradient
    /// normals.
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
    std::size_t left_ = 0;  // queries of the batch that the CPU did not answer
    DeviceAnswers device_;
    std::vector<FoundSample> samples_;
    decode::FieldDecoder fields_;
};

}  // namespace nearfield::results
