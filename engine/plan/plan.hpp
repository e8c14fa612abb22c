#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/plan/boundary_points.hpp>
#include <engine/plan/checked_query.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/field_parts.hpp>
#include <engine/plan/grid.hpp>
#include <engine/plan/needed_blocks.hpp>
#include <nearfield/localization.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <shaders/search.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace nearfield::plan {

enum class TileKind : std::uint8_t {
    points,   ///< depth of boundary points
    field,    ///< signed distance at every cell
    overlap,  ///< samples in both shapes
};

/// A rectangle of cells of one query's grid.
struct Tile {
    std::uint32_t query = 0;
    TileKind kind{};
    std::uint32_t region = 0;  ///< the query's region that it belongs to
    Grid grid;                 ///< of that region
    std::uint64_t column = 0;  ///< in that grid, of the tile's low corner without its halo
    std::uint64_t row = 0;
    std::uint32_t width = 0;  ///< drawn, the halo included
    std::uint32_t height = 0;
    std::uint32_t halo = 0;  ///< cells drawn around the tile's own cells, on every side
    std::uint32_t tile_batch =
        0;  ///< that it is part of, and its place in the atlas if it is drawn
    std::uint32_t atlas_x = 0;
    std::uint32_t atlas_y = 0;
    /// The blocks of the tile that hold points; all of them for a field. Unused for overlap.
    NeededBlocks needed;

    /// Centre of the drawn cells, in cells of the tile.
    [[nodiscard]] geometry::Vector centre() const { return {0.5 * width, 0.5 * height}; }
    /// Low corner of the drawn cells, in the world.
    [[nodiscard]] geometry::Vector origin() const {
        return grid.origin + grid.cell * geometry::Vector(static_cast<double>(column) - halo,
                                                          static_cast<double>(row) - halo);
    }
};

/// A boundary point and the tile that its cell belongs to.
struct PlannedPoint {
    static constexpr std::uint32_t no_tile = UINT32_MAX;  ///< for points that the device has found

    BoundaryPoint point;
    std::uint32_t tile = 0;
};

/// A point at which a field is reconstructed, between four cells of a tile.
struct PlannedFieldPoint {
    geometry::Vector position;  ///< in the world
    std::uint32_t tile = 0;
    std::uint32_t column = 0;  ///< of the low one of the four cells, in the tile, or grid, as drawn
    std::uint32_t row = 0;
    double across = 0.0;  ///< fraction from the centre of that cell to the next, along x
    double up = 0.0;      ///< and along y
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
    FieldParts parts;
    std::uint32_t first_point = 0;  ///< in Plan::field_points
    std::uint32_t point_count = 0;
    /// Of a resident field: no cell is farther from B's boundary, world units.
    double farthest = 0.0;
};

/// The planned form of a query that a device answers, or of one direction of it.
struct PlannedQuery : CheckedQuery {
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
    std::vector<SearchDirectionData> directions;  ///< `a`: the query's place in Plan::queries
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
    /// Contact queries with gradient normals.
    std::vector<std::uint32_t> with_gradient_normals;
    std::vector<Tile> tiles;
    std::vector<PlannedPoint> points;             ///< in order of queries, then along A's rings
    std::vector<PlannedFieldPoint> field_points;  ///< by query, then as in the query
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

}  // namespace nearfield::plan
