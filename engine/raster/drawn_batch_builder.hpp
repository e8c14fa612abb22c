#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/queries/simplified_shapes.hpp>
#include <engine/queries/tile_edges.hpp>
#include <engine/raster/atlas.hpp>
#include <engine/raster/distance_mesh.hpp>
#include <engine/raster/drawn_batch.hpp>
#include <engine/raster/nearest_edges.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace nearfield::raster {

/// Divides the drawn tiles of a plan among tile batches, and turns those of each into meshes, edge
/// lists and points. Keeps its scratch memory.
class DrawnBatchBuilder {
public:
    explicit DrawnBatchBuilder(geometry::SubpixelGrid grid) : grid_(grid) {}

    /// Replaces the first tile batches; returns their number.
    [[nodiscard]] std::uint32_t build(const device_input::Plan& plan,
                                      std::vector<DrawnBatch>& batches);
    /// The smallest images that hold any of them.
    [[nodiscard]] TileSize extent() const { return atlas_.extent(); }

private:
    void place_tiles(const device_input::Plan& plan);
    /// Selects the largest tiles of each tile batch that are worth an occlusion query.
    void select_watched(const device_input::Plan& plan, std::vector<DrawnBatch>& batches) const;
    // Each adds what is drawn for the last tile of a batch.
    /// Returns false where the CPU decides the points of the tile, and nothing is drawn.
    [[nodiscard]] bool add_distance_tile(const device_input::PlannedQuery& query,
                                         const device_input::PlannedTile& tile, DrawnBatch& batch);
    void add_field(const device_input::PlannedQuery& query, const device_input::PlannedTile& tile,
                   DrawnBatch& batch) const;
    void add_overlap_tile(const device_input::PlannedQuery& query,
                          const device_input::PlannedTile& tile, DrawnBatch& batch);
    void add_volume(const queries::TileBoundary& boundary, const shaders::TileData& tile,
                    double slack, geometry::Mesh& parity, geometry::Mesh& rectangles);
    void add_overlap_b(const device_input::PlannedQuery& query,
                       const device_input::PlannedTile& tile,
                       const device_input::OverlapTile& overlap, DrawnBatch& batch);
    void add_overlap_a(const device_input::PlannedQuery& query,
                       const device_input::PlannedTile& tile,
                       const device_input::OverlapTile& overlap, DrawnBatch& batch);
    void add_points(const device_input::Plan& plan, std::vector<DrawnBatch>& batches) const;
    void add_field_points(const device_input::Plan& plan, std::vector<DrawnBatch>& batches) const;
    void add_fill(const std::vector<queries::TileEdge>& edges, const shaders::TileData& tile,
                  geometry::Mesh& mesh) const;
    /// `runs`: of the offset polygons' ids; null: ids are 0.
    void add_boundary(const queries::TileBoundary& boundary, const shaders::TileData& tile,
                      double offset, std::vector<queries::EdgeRun>* runs,
                      geometry::Mesh& mesh) const;
    /// The entry of nearest_ for a simplified edge, or null; most likely the one before `hint`.
    [[nodiscard]] const NearestEdge* find_nearest(std::uint32_t simplified,
                                                  std::uint32_t hint) const;
    void add_distance_mesh(const queries::TileBoundary& boundary, const shaders::TileData& tile,
                           double error, std::vector<TileVertex>& mesh);

    geometry::SubpixelGrid grid_;
    AtlasPacker atlas_;
    std::array<std::vector<std::uint32_t>, 1 + intersection_strategies> drawn_together_;  // tiles
    std::vector<AtlasPlace> places_;  // by tile of the plan
    queries::SimplifiedShapes shapes_;
    std::vector<queries::TileEdge> crossing_;
    std::vector<NearestEdge> nearest_;
    std::vector<queries::TileEdge> nearest_list_;
    NearestEdgeFinder finder_;
    DistanceMesh distance_mesh_;               // of one tile
    std::vector<geometry::Vector> tangents_;   // by nearest edge
    std::vector<std::uint32_t> tile_of_plan_;  // by tile of the plan: its index in the tile batch
};

}  // namespace nearfield::raster
