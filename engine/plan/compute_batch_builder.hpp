#pragma once

#include <engine/geometry/mesh.hpp>
#include <engine/plan/block_edges.hpp>
#include <engine/plan/compute_work.hpp>
#include <engine/plan/nearest_edges.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <engine/plan/tile_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::plan {

struct FieldTile;
struct OverlapTile;
struct TileBatch;

/// Turns the tiles of a tile batch of the compute technique into its work: masks, lists of near
/// edges, blocks. Keeps its scratch memory.
class ComputeBuilder {
public:
    explicit ComputeBuilder(geometry::SubpixelGrid grid) : grid_(grid) {}

    /// Adds the edge lists of a tile of boundary points; false, with nothing added, if the tile is
    /// left to the CPU.
    [[nodiscard]] bool add_points_tile(const PlannedQuery& query, const Tile& tile,
                                       SimplifiedShapes& shapes, TileData& data, TileBatch& batch);
    /// Adds the mask of a field tile, and its blocks with their edge lists. `field` says where in
    /// the read-back the requested outputs go.
    void add_field_tile(const PlannedQuery& query, const Tile& tile, const FieldTile& field,
                        SimplifiedShapes& shapes, TileBatch& batch);
    /// Adds an overlap tile. `asked` says whether each shape takes part by its volume or its
    /// boundary.
    void add_overlap_tile(const PlannedQuery& query, const Tile& tile, const OverlapTile& asked,
                          SimplifiedShapes& shapes, TileBatch& batch);
    /// Adds a point of a field tile that has been added already. `first_block`: the tile's first
    /// block in ComputeWork::feature_blocks.
    static void add_field_point(const Tile& tile, std::uint32_t first_block,
                                const PlannedFieldPoint& point, ComputeWork& work);

private:
    [[nodiscard]] EdgeListData add_crossing(const TileBoundary& boundary, const Tile& tile,
                                            double slack, TileBatch& batch);
    void add_blocks(const TileBoundary& boundary, const Tile& tile, const MaskData& mask,
                    std::uint32_t first_value, ComputeWork& work);
    void add_feature_blocks(const PlannedQuery& query, const TileBoundary& boundary,
                            const Tile& tile, const MaskData& mask, std::uint32_t first_feature,
                            TileBatch& batch);
    /// Fills a mask with the shape whose edges are in crossing_.
    void add_fill(const Tile& tile, std::uint32_t mask, ComputeWork& work) const;
    void add_boundary(const TileBoundary& boundary, const Tile& tile, double offset,
                      std::uint32_t overlap, bool of_a, TileBatch& batch) const;

    geometry::SubpixelGrid grid_;
    NearestEdgeFinder finder_;  // for points, which are sparse in their tile
    BlockEdges block_edges_;    // for fields
    std::vector<NearestEdge> nearest_;
    std::vector<TileEdge> nearest_list_;
    std::vector<TileEdge> crossing_;
};

}  // namespace nearfield::plan
