#pragma once

#include <engine/geometry/vector.hpp>
#include <nearfield/on_device.hpp>

#include <shaders/export.h>
#include <shaders/push.h>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// The outputs of a batch that stay on the device, in the form that the export passes take.

/// For shaders.
[[nodiscard]] inline shaders::vec2 rounded(const geometry::Vector& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y())};
}

/// The cells of one tile in the field words of a tile batch.
struct FieldPartOutput {
    std::uint32_t tile_batch = 0;
    shaders::ExportFieldPush cells{};
};

/// A field that is exported as images.
struct FieldOutputs {
    std::uint32_t query = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    geometry::Vector origin = geometry::Vector::Zero();
    double cell = 0.0;
    double error_bound = 0.0;
    FieldTarget target;            ///< images of the host, where their handles are not null
    bool has_features = true;      ///< otherwise there are only distances
    std::uint32_t first_part = 0;  ///< in ResidentOutputs::field_parts
    std::uint32_t part_count = 0;
};

/// What the search finds in one direction of a query.
struct RecordRunOutput {
    std::uint32_t direction = 0;  ///< in Plan::pairs
    std::uint32_t blocks = 0;     ///< of points, at most
    std::uint32_t flags = 0;      ///< point_flags of its records
    shaders::vec2 frame_axis;     ///< as in SearchPush
    shaders::vec2 frame_place;
};

/// What goes to a buffer: a summary, and records or samples behind it.
struct BufferOutput {
    std::uint32_t query = 0;
    std::uint32_t capacity = 0;  ///< records, or cells; 0 where the samples are omitted
    geometry::Vector origin = geometry::Vector::Zero();
    double cell = 0.0;
    double error_bound = 0.0;
    BufferTarget target;          ///< the host's, if its handle is not null
    std::uint32_t first_run = 0;  ///< in ResidentOutputs::record_runs, or sample_runs
    std::uint32_t run_count = 0;
    std::uint64_t bytes = 0;        ///< in the buffer
    std::uint64_t block_bytes = 0;  ///< that the passes keep from step to step
};

/// Tiles of one intersection in one tile batch.
struct SampleRunOutput {
    std::uint32_t tile_batch = 0;
    std::uint32_t first_tile = 0;  ///< in ResidentOutputs::sample_tiles
    std::uint32_t tile_count = 0;
    std::uint32_t table = 0;  ///< where they lie in the tables
};

/// An intersection that is exported as a summary and samples.
struct SamplesOutput : BufferOutput {
    std::uint32_t tile_count = 0;
    std::uint32_t block_count = 0;  ///< 0 where the samples are omitted
};

struct ResidentOutputs {
    std::vector<FieldOutputs> fields;
    std::vector<FieldPartOutput> field_parts;
    std::vector<BufferOutput> records;
    std::vector<RecordRunOutput> record_runs;
    std::vector<SamplesOutput> samples;
    std::vector<SampleRunOutput> sample_runs;
    std::vector<shaders::SampleTileData> sample_tiles;
    std::vector<std::uint32_t> tables;

    void clear() {
        fields.clear();
        field_parts.clear();
        records.clear();
        record_runs.clear();
        samples.clear();
        sample_runs.clear();
        sample_tiles.clear();
        tables.clear();
    }
    [[nodiscard]] bool empty() const {
        return fields.empty() && records.empty() && samples.empty();
    }
};

}  // namespace nearfield::device_input
