#pragma once

#include <engine/batch/field_results.hpp>
#include <engine/batch/found_pairs.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/device_input/tile_batch.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::batch {

/// What the device has answered of a batch, as it is read back, tile batch by tile batch.
class DeviceAnswers {
public:
    explicit DeviceAnswers(const char* gradient_format) : fields_(gradient_format) {}

    void begin_batch(const device_input::Plan& plan);

    /// Decodes the read-back of one tile batch.
    void add_points(const device_input::TileBatch& batch, std::span<const std::uint32_t> words);
    /// What a search has found out, which has to stay until the results are written.
    [[nodiscard]] FoundPairs& pairs() { return pairs_; }
    [[nodiscard]] const FoundPairs& pairs() const { return pairs_; }
    static void add_summaries(const device_input::Plan& plan, const device_input::TileBatch& batch,
                              std::span<const shaders::TileSummary> summaries,
                              std::vector<AnyResult>& results);
    void add_field(const device_input::Plan& plan, const device_input::TileBatch& batch,
                   std::span<const std::uint32_t> words, std::vector<AnyResult>& results) {
        fields_.add(plan, batch, words, results);
    }
    /// Makes the results of a tile batch's fields errors: the device did not answer all cells.
    void refuse_fields(const device_input::Plan& plan, const device_input::TileBatch& batch) {
        fields_.refuse(plan, batch);
    }
    void add_samples(const device_input::Plan& plan, const device_input::TileBatch& batch,
                     std::span<const shaders::SampleData> samples);

    /// The points of a planned query.
    [[nodiscard]] QueryPoints points_of(const device_input::Plan& plan, std::uint32_t query) const;
    /// The words of points that were planned.
    [[nodiscard]] std::span<const std::uint32_t> words_of(
        const device_input::PlannedPoints& points) const {
        return std::span(words_).subspan(points.first, points.count);
    }
    [[nodiscard]] const FieldDecoder& fields() const { return fields_; }
    /// Appends the samples to the results, in order.
    void write_drawn_samples(std::vector<AnyResult>& results);

private:
    struct FoundSample {
        std::uint32_t query = 0;
        std::uint32_t region = 0;
        std::uint64_t row = 0;
        std::uint64_t column = 0;
        IntersectionSample sample;
    };

    std::vector<std::uint32_t> words_;  // by point of the plan
    FoundPairs pairs_;
    std::vector<FoundSample> samples_;
    FieldDecoder fields_;
};

}  // namespace nearfield::batch
