#pragma once

#include <engine/geometry/distance_mesh.hpp>
#include <engine/geometry/mesh.hpp>
#include <engine/plan/compute_batch_builder.hpp>
#include <engine/plan/compute_work.hpp>
#include <engine/plan/edge_lists.hpp>
#include <engine/plan/nearest_edges.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <engine/plan/tile_edges.hpp>
#include <engine/plan/tile_meshes.hpp>

#include <shaders/layout.h>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// Consecutive edges of a shape.
struct EdgeRun {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// How a shape is drawn into an overlap tile.
enum class Part : std::uint8_t { volume, boundary };

/// Maximum number of occlusion queries of a tile batch, each of which costs a draw.
inline constexpr std::uint32_t max_watched = 4;

/// An overlap tile with an occlusion query around A's last draw into it.
struct WatchedTile {
    std::uint32_t tile = 0;  ///< in TileBatch::tiles
    IntersectionStrategy strategy{};
    Part part_a{};
    DrawRange a;  ///< in the mesh OverlapStep::watched_a of the strategy
};

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
    std::uint32_t first_value = not_asked;     ///< one word per cell
    std::uint32_t first_feature = not_asked;   ///< one word per cell
    std::uint32_t first_gradient = not_asked;  ///< two words per cell
};

/// The points of one field query that a tile batch answers.
struct FieldPointRun {
    std::uint32_t first = 0;  ///< in TileBatch::field_points
    std::uint32_t count = 0;
    std::uint32_t query = 0;       ///< in Plan::queries
    std::uint32_t first_word = 0;  ///< in the field's read-back
    SignEncoding sign = SignEncoding::stencil;
    FieldParts parts;
};

/// Consecutive 32-bit words.
struct WordRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// One of the lists of cell groups of a tile batch: of its fields with an encoding of the sign, or
/// of its intersections by a strategy.
[[nodiscard]] constexpr std::size_t group_list(SignEncoding sign) {
    return static_cast<std::size_t>(sign);
}
[[nodiscard]] constexpr std::size_t group_list(IntersectionStrategy strategy) {
    return sign_encodings + static_cast<std::size_t>(strategy);
}
inline constexpr std::size_t group_lists = sign_encodings + intersection_strategies;

/// What is drawn in a tile batch of the raster technique.
struct RasterWork {
    TileMeshes meshes;
    TileSize extent;  ///< of the atlas that the tiles take
    std::array<std::vector<CellGroup>, group_lists> groups;
    std::array<std::vector<OverlapTile>, intersection_strategies> overlaps;  ///< by strategy
    std::vector<WatchedTile> watched;                                        ///< by occlusion query
    std::vector<TilePointData> field_points;

    void clear();
};

/// Tiles that the device works on at once, in the form that it takes.
struct TileBatch {
    std::vector<TileData> tiles;
    std::vector<std::uint32_t> tile_index;  ///< by tile: its position in Plan::tiles
    EdgeListWriter lists;
    std::vector<TilePointData> points;
    std::vector<std::uint32_t> point_index;  ///< by point: its position in Plan::points
    std::vector<EdgeRun> runs;       ///< of A's edges, which drawn offset polygons' ids refer to
    std::uint64_t listed_cells = 0;  ///< cells of all overlap tiles whose samples are listed
    bool keeps_hits = false;         ///< there are overlap tiles whose hits are kept
    std::vector<FieldTile> field_tiles;
    std::vector<std::uint32_t> field_point_index;  ///< by point: in Plan::field_points
    std::vector<FieldPointRun> field_point_runs;
    std::uint64_t field_words = 0;           ///< for all fields together
    std::vector<WordRange> field_read_back;  ///< those that the host reads
    bool resident = false;                   ///< there are fields that stay on the device
    /// A tile batch is either drawn or, by the compute technique, computed; the other work is
    /// empty, and keeps its memory.
    bool by_compute = false;
    RasterWork raster;
    ComputeWork compute;

    /// Position of a list's first group in the buffer of tiles, in units of a group.
    [[nodiscard]] std::uint32_t first_group(std::size_t list) const;
    void clear();
};

/// Turns the tiles of one tile batch into meshes, edge lists and points. Keeps its scratch memory.
class TileBatchBuilder {
public:
    explicit TileBatchBuilder(geometry::SubpixelGrid grid) : grid_(grid) {}

    /// Drops simplified shapes; call first in each batch, since shapes may have changed.
    void begin_batch() {
        shapes_.clear();
        compute_.begin_batch();
    }
    /// Forgets what shapes earlier batches have left in the device's memory; all tile batches of
    /// the present one have to be built again.
    void forget_shapes() { compute_.forget_shapes(); }
    void build(const Plan& plan, std::uint32_t number, TileBatch& batch);

private:
    /// Selects the largest tiles that are worth an occlusion query.
    void select_watched(const Plan& plan, std::uint32_t number);
    /// Adds what only the technique of the batch needs for its last tile.
    void add_drawn_tile(const PlannedQuery& query, const Tile& tile, TileBatch& batch);
    void add_compute_tile(const PlannedQuery& query, const Tile& tile, TileBatch& batch);
    void add_distance_tile(const PlannedQuery& query, const Tile& tile, TileBatch& batch);
    /// Reserves space in the read-back for the requested outputs at cells.
    static const FieldTile& add_field_tile(const PlannedQuery& query, const Tile& tile,
                                           TileBatch& batch);
    /// Adds what only fields have drawn; their tile is the last one.
    void add_drawn_field(const PlannedQuery& query, const Tile& tile, TileBatch& batch) const;
    /// Appends words to those of the fields; returns the first one.
    static std::uint32_t add_field_words(std::uint64_t count, bool for_host, TileBatch& batch);
    /// Determines which part of each shape takes part, and whether samples are listed or kept.
    static OverlapTile describe_overlap(const IntersectionQuery& query, const Tile& tile,
                                        TileBatch& batch);
    void add_overlap_tile(const PlannedQuery& query, const Tile& tile, TileBatch& batch);
    void add_volume(const TileBoundary& boundary, const Tile& tile, double slack,
                    geometry::Mesh& parity, geometry::Mesh& rectangles);
    void add_overlap_b(const PlannedQuery& query, const Tile& tile, const OverlapTile& overlap,
                       TileBatch& batch);
    void add_overlap_a(const PlannedQuery& query, const Tile& tile, const OverlapTile& overlap,
                       TileBatch& batch);
    void add_points(const Plan& plan, std::uint32_t number, TileBatch& batch);
    void add_field_points(const Plan& plan, std::uint32_t number, TileBatch& batch);
    void add_fill(const std::vector<TileEdge>& edges, const Tile& tile, geometry::Mesh& mesh) const;
    /// `runs`: of the offset polygons' ids; null: ids are 0.
    void add_boundary(const TileBoundary& boundary, const Tile& tile, double offset,
                      std::vector<EdgeRun>* runs, geometry::Mesh& mesh) const;
    /// The entry of nearest_ for a simplified edge, or null; most likely the one before `hint`.
    [[nodiscard]] const NearestEdge* find_nearest(std::uint32_t simplified,
                                                  std::uint32_t hint) const;
    void add_distance_mesh(const TileBoundary& boundary, const Tile& tile, double error,
                           std::vector<TileVertex>& mesh);

    geometry::SubpixelGrid grid_;
    SimplifiedShapes shapes_;
    std::vector<TileEdge> crossing_;
    std::vector<NearestEdge> nearest_;
    std::vector<TileEdge> nearest_list_;
    NearestEdgeFinder finder_;
    geometry::DistanceMesh distance_mesh_;     // of one tile
    std::vector<geometry::Vector> tangents_;   // by nearest edge
    std::vector<std::uint32_t> watched_;       // tiles of the plan
    std::vector<std::uint32_t> tile_of_plan_;  // by tile of the plan: its index in the tile batch
    std::vector<bool> left_to_cpu_;            // by tile of the tile batch: so are its points
    // By tile of the plan: its index among the field tiles of the compute technique.
    std::vector<std::uint32_t> field_tile_of_plan_;
    ComputeBuilder compute_;
};

}  // namespace nearfield::plan
