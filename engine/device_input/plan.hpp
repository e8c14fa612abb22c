#pragma once

#include <engine/device_input/needed_blocks.hpp>
#include <engine/geometry/mesh.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/queries/checked_query.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/queries/field_grid.hpp>
#include <engine/queries/grid.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <shaders/search.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace nearfield::device_input {

enum class TileKind : std::uint8_t {
    points,   ///< depth of boundary points
    field,    ///< signed distance at every cell
    overlap,  ///< samples in both shapes
};

/// A tile of a query that a device works on.
struct PlannedTile : queries::Tile {
    std::uint32_t query = 0;
    TileKind kind{};
    std::uint32_t tile_batch = 0;  ///< that it is part of
    std::uint32_t atlas_x = 0;     ///< its place there, if it is drawn
    std::uint32_t atlas_y = 0;
    /// The blocks of the tile that hold points; all of them for a field. Unused for overlap.
    NeededBlocks needed;
};
static_assert(sizeof(PlannedTile) <= queries::bytes_of_tile);

/// A boundary point and the tile that its cell belongs to.
struct PlannedPoint {
    static constexpr std::uint32_t no_tile = UINT32_MAX;  ///< for points that the device has found

    queries::BoundaryPoint point;
    std::uint32_t tile = 0;
};

/// Who decides which points of a boundary matter to a query.
enum class PointSource : std::uint8_t {
    planner,  ///< they are in Plan::points
    device,   ///< Technique::compute: its search between pairs (Plan::pairs) finds them
};

/// The points of A's boundary that a query, or one direction of it, resolves in the field of B.
struct PlannedPoints {
    static constexpr std::uint32_t none = UINT32_MAX;

    PointSource source = PointSource::planner;
    bool outside = false;     ///< points outside B are resolved as well
    std::uint32_t first = 0;  ///< in Plan::points
    std::uint32_t count = 0;
    /// Only the number of penetrating points and the deepest are asked for.
    bool summarized = false;
    double margin = 0.0;  ///< where the device finds them: bound on its errors, world units
    /// Index in Plan::queries of the other direction: points of B in the field of A.
    std::uint32_t reverse = none;

    [[nodiscard]] std::uint32_t end() const { return first + count; }
};

/// What is planned for a distance field.
struct PlannedField {
    queries::FieldParts parts;
    std::uint32_t first_point = 0;  ///< in Plan::field_points
    std::uint32_t point_count = 0;
    /// Of a resident field: no cell is farther from B's boundary, world units.
    double farthest = 0.0;
};

/// The planned form of a query that a device answers, or of one direction of it.
struct PlannedQuery : queries::CheckedQuery {
    /// Its results stay on the device as well.
    bool on_device = false;
    /// Nothing for an intersection, or a query that was rejected.
    std::variant<std::monostate, PlannedPoints, PlannedField> work;

    [[nodiscard]] PlannedPoints& points() { return std::get<PlannedPoints>(work); }
    [[nodiscard]] const PlannedPoints& points() const { return std::get<PlannedPoints>(work); }
    [[nodiscard]] const PlannedField& field() const { return std::get<PlannedField>(work); }
    /// Whether the query is about points, from this source.
    [[nodiscard]] bool has_points_of(PointSource source) const {
        const auto* const points = std::get_if<PlannedPoints>(&work);
        return points != nullptr && points->source == source;
    }
};

/// The pairs that a batch gives to the device's search: queries, or directions of them, whose
/// points it finds.
struct GivenPairs {
    /// `a`: the query's place in Plan::queries.
    std::vector<shaders::SearchDirectionData> directions;
    std::uint32_t items = 0;
    double max_edges = 0.0;  ///< upper bounds on what the device may find
    double max_points = 0.0;

    void clear() {
        directions.clear();
        items = 0;
        max_edges = max_points = 0.0;
    }
};

/// The queries of a batch that a device answers, as tiles and searches.
struct Plan {
    /// By position in the batch, where a device answers, followed by the other directions of some
    /// queries.
    std::vector<PlannedQuery> queries;
    std::vector<std::uint32_t> resident;  ///< queries whose results stay on the device as well
    GivenPairs pairs;                     ///< that the device searches
    std::vector<PlannedTile> tiles;
    std::vector<PlannedPoint> points;  ///< in order of queries, then along A's rings
    std::vector<queries::PlacedFieldPoint> field_points;  ///< by query, then as in the query
    /// Cells along a side of the largest image of drawn tiles. A tile batch of the compute
    /// technique takes as many cells as it has.
    std::uint32_t largest_atlas = 0;
    /// Bytes that all results may need on the host.
    double result_bytes = 0.0;
    double localize_milliseconds = 0.0;  ///< spent in hierarchies
    /// The times of the batch's queries, which planning and answering add to; empty if nobody asked
    /// for them. Outlives clear().
    std::span<QueryTime> times;

    void clear();
};

}  // namespace nearfield::device_input
