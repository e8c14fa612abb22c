#pragma once

#include <engine/geometry/vector.hpp>
#include <nearfield/resident.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// The outputs of a batch that stay on the device, in the form that the export passes take
/// (shaders/export_field.comp, export_records.comp, export_samples.comp).

/// Points from which one thread makes records, one after the other.
inline constexpr std::uint32_t points_per_block = 32;

/// Counts for such a block, or for all blocks before it.
struct RecordBlockData {
    std::uint32_t count = 0;
    std::uint32_t deepest = 0;
    float depth = 0.0F;
    std::uint32_t unused = 0;
    float low[2]{};
    float high[2]{};
};
static_assert(sizeof(RecordBlockData) == 32);

/// Rings of a polygon in the tables: the first edge of each ring, then the number of all edges.
struct RingTable {
    std::uint32_t first_word = 0;
    std::uint32_t count = 0;  ///< of rings
};

/// The cells of one tile: their position in the field words of a tile batch and in the images.
struct FieldPartOutput {
    std::uint32_t tile_batch = 0;
    std::uint32_t value = 0;    ///< word of the first cell's value,
    std::uint32_t feature = 0;  ///< and of its feature
    std::uint32_t stride = 0;   ///< words from row to row
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t column = 0;  ///< of the first cell in the images
    std::uint32_t row = 0;
};

/// A field that is exported as images.
struct FieldOutputs {
    std::uint32_t query = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    geometry::Vector origin = geometry::Vector::Zero();
    double cell = 0.0;
    double error_bound = 0.0;
    ResidentFieldTarget target;    ///< images of the host, where their handles are not null
    RingTable rings;               ///< of B
    std::uint32_t first_part = 0;  ///< in ResidentOutputs::field_parts
    std::uint32_t part_count = 0;
};

/// Points of one boundary that one tile batch resolves.
struct PointRunOutput {
    std::uint32_t tile_batch = 0;
    std::uint32_t first = 0;  ///< in TileBatch::points
    std::uint32_t count = 0;
    std::uint32_t first_block = 0;  ///< of the query's
    /// Where they lie in the tables, four words each: the position relative to the query's origin
    /// (two floats), B's normal if it is B's point (packSnorm2x16), the place among the points of
    /// the query.
    std::uint32_t table = 0;
    RingTable rings;          ///< of the shape whose features they name
    std::uint32_t flags = 0;  ///< resident_flags of their records

    [[nodiscard]] std::uint32_t blocks() const {
        return (count + points_per_block - 1) / points_per_block;
    }
};

/// Points that are exported as records.
struct RecordsOutput {
    std::uint32_t query = 0;
    std::uint32_t capacity = 0;  ///< points
    double max_capacity = 0.0;   ///< upper bound, at any poses
    geometry::Vector origin = geometry::Vector::Zero();
    double cell = 0.0;
    double error_bound = 0.0;
    ResidentBufferTarget target;  ///< the host's, if its handle is not null
    float near = -1.0F;           ///< contacts: maximum distance, world units
    std::uint32_t first_run = 0;  ///< in ResidentOutputs::point_runs
    std::uint32_t run_count = 0;
    std::uint32_t block_count = 0;
};

/// Replaces the word of something that does not exist.
inline constexpr std::uint32_t no_word = UINT32_MAX;

/// A tile of an intersection, as stored in the tables. The hits in its cells lie in the words of
/// its tile batch: one word per cell where drawn, two masks by the compute technique.
struct SampleTileData {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    /// Each row of cells is one of the query's blocks, starting at the lowest row; `block_step`
    /// blocks lie between one row and the next, for the rows of the tiles beside it.
    std::uint32_t first_block = 0;
    std::uint32_t block_step = 0;
    std::uint32_t hits = 0;             ///< word of the first cell's hit, or of the mask of B
    std::uint32_t mask_a = no_word;     ///< word of the mask of A; no_word where it was drawn
    std::uint32_t words_per_row = 0;    ///< of the masks
    std::uint32_t runs = no_word;       ///< with masks: word of the first cell's run of A's edges
    std::uint32_t run_table = no_word;  ///< word of the tables where the batch's runs start, two
                                        ///< words each; no_word where A takes part by its volume
    std::uint32_t summary = 0;          ///< index among the summaries of its tile batch
    std::uint32_t region = 0;
    float corner_x = 0.0F;  ///< low corner of the tile, relative to the query's origin
    float corner_y = 0.0F;
};
static_assert(sizeof(SampleTileData) == 52);

/// Box of a tile's samples, before the counts of all rows.
struct SampleBoxData {
    std::uint32_t count = 0;
    float low[2]{};
    float high[2]{};
};
static_assert(sizeof(SampleBoxData) == 20);

/// Tiles of one intersection in one tile batch.
struct SampleRunOutput {
    std::uint32_t tile_batch = 0;
    std::uint32_t first_tile = 0;  ///< in ResidentOutputs::sample_tiles
    std::uint32_t tile_count = 0;
    std::uint32_t table = 0;  ///< where they lie in the tables
};

/// An intersection that is exported as a summary and samples.
struct SamplesOutput {
    std::uint32_t query = 0;
    std::uint32_t capacity = 0;  ///< cells; 0 where the samples are omitted
    geometry::Vector origin = geometry::Vector::Zero();
    double cell = 0.0;
    double error_bound = 0.0;
    ResidentBufferTarget target;  ///< the host's, if its handle is not null
    RingTable rings;              ///< of A, where it takes part by its boundary,
    std::uint32_t vertices = 0;   ///< and where its vertices lie in the tables, two floats each
    std::uint32_t first_run = 0;  ///< in ResidentOutputs::sample_runs
    std::uint32_t run_count = 0;
    std::uint32_t tile_count = 0;
    std::uint32_t block_count = 0;  ///< 0 where the samples are omitted
};

struct ResidentOutputs {
    std::vector<FieldOutputs> fields;
    std::vector<FieldPartOutput> field_parts;
    std::vector<RecordsOutput> records;
    std::vector<PointRunOutput> point_runs;
    std::vector<SamplesOutput> samples;
    std::vector<SampleRunOutput> sample_runs;
    std::vector<SampleTileData> sample_tiles;
    std::vector<std::uint32_t> tables;

    void clear() {
        fields.clear();
        field_parts.clear();
        records.clear();
        point_runs.clear();
        samples.clear();
        sample_runs.clear();
        sample_tiles.clear();
        tables.clear();
    }
    [[nodiscard]] bool empty() const {
        return fields.empty() && records.empty() && samples.empty();
    }
};

}  // namespace nearfield::plan
