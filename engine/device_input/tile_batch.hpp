#pragma once

#include <engine/device_input/plan.hpp>
#include <engine/queries/tile_edges.hpp>

#include <shaders/layout.h>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// How a shape is drawn into an overlap tile.
enum class Part : std::uint8_t { volume, boundary };

/// An overlap tile: which part of each shape takes part, and what becomes of its samples.
struct OverlapTile {
    std::uint32_t tile = 0;  ///< in TileBatch::tiles
    Part part_a = Part::volume;
    Part part_b = Part::volume;
    bool lists = false;       ///< samples are listed, not only counted
    bool keeps_hits = false;  ///< the hits of the cells stay on the device
};

/// A field tile: where the requested outputs at cells start, in 32-bit words of the field's
/// read-back.
struct FieldTile {
    std::uint32_t tile = 0;  ///< in TileBatch::tiles
    SignEncoding sign = SignEncoding::stencil;
    std::uint32_t first_value = shaders::not_asked;     ///< one word per cell
    std::uint32_t first_feature = shaders::not_asked;   ///< one word per cell
    std::uint32_t first_gradient = shaders::not_asked;  ///< two words per cell
};

/// The points of one field query that a tile batch answers.
struct FieldPointRun {
    std::uint32_t first = 0;  ///< in TileBatch::field_points
    std::uint32_t count = 0;
    std::uint32_t query = 0;       ///< in Plan::queries
    std::uint32_t first_word = 0;  ///< in the field's read-back
    SignEncoding sign = SignEncoding::stencil;
    queries::FieldParts parts;
};

/// Consecutive 32-bit words.
struct WordRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Tiles that a device works on at once, and what it writes of them for the host.
struct TileBatch {
    std::vector<shaders::TileData> tiles;
    std::vector<std::uint32_t> tile_index;  ///< by tile: its position in Plan::tiles
    std::vector<shaders::TilePointData> points;
    std::vector<std::uint32_t> point_index;  ///< by point: its position in Plan::points
    std::uint64_t listed_cells = 0;  ///< cells of all overlap tiles whose samples are listed
    /// Of A's edges: samples name a run of these, or without any an edge.
    std::vector<queries::EdgeRun> runs;
    std::vector<FieldTile> field_tiles;
    std::vector<std::uint32_t> field_point_index;  ///< by point: in Plan::field_points
    std::vector<FieldPointRun> field_point_runs;
    std::uint64_t field_words = 0;           ///< for all fields together
    std::vector<WordRange> field_read_back;  ///< those that the host reads

    void clear();
    /// Adds a tile, without what only its technique has the device know of it.
    void add_tile(const PlannedTile& tile, std::uint32_t index);
    /// Reserves space in the read-back for the requested outputs at cells of the last tile.
    const FieldTile& add_field_tile(const PlannedQuery& query, const PlannedTile& tile);
    /// The last tile: which part of each shape takes part, and whether samples are listed or kept.
    OverlapTile add_overlap_tile(const IntersectionQuery& query, const PlannedTile& tile);
    /// Adds a point of a field, and reserves space for it.
    void add_field_point(const Plan& plan, std::uint32_t index);

private:
    /// Appends words to those of the fields; returns the first one.
    std::uint32_t add_field_words(std::uint64_t count, bool for_host);
};

}  // namespace nearfield::device_input
