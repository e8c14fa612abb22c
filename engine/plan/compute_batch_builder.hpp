#pragma once

#include <engine/plan/compute_work.hpp>
#include <engine/plan/nearest_edges.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/shapes_in_tiles.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <engine/plan/tile_edges.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::plan {

struct FieldTile;
struct OverlapTile;
struct TileBatch;

/// Turns the tiles of a tile batch of the compute technique into its work: masks, fields, lists of
/// near edges. Keeps its scratch memory.
class ComputeBuilder {
public:
    /// Call first in each batch.
    void begin_batch() { shapes_.begin_batch(); }
    void forget_shapes() { shapes_.clear(); }
    /// Adds the edge lists of a tile of boundary points; false, with nothing added, if the tile is
    /// left to the CPU.
    [[nodiscard]] bool add_points_tile(const PlannedQuery& query, const Tile& tile,
                                       SimplifiedShapes& shapes, TileData& data, TileBatch& batch);
    /// Adds a field tile. `field` says where in the read-back the requested outputs go.
    void add_field_tile(const PlannedQuery& query, const Tile& tile, const FieldTile& field,
                        ComputeWork& work);
    /// Adds an overlap tile. `asked` says whether each shape takes part by its volume or its
    /// boundary.
    void add_overlap_tile(const PlannedQuery& query, const Tile& tile, const OverlapTile& asked,
                          ComputeWork& work);

private:
    /// Adds a shape with a mask of a tile. `reach`, `first_edge`: see MaskShapeData.
    void add_mask_shape(const ShapeInTileData& seen, const Tile& tile, double reach,
                        std::uint32_t first_edge, ComputeWork& work) const;

    ShapesInTiles shapes_;
    NearestEdgeFinder finder_;
    std::vector<NearestEdge> nearest_;
    std::vector<TileEdge> nearest_list_;
    std::vector<TileEdge> crossing_;
};

}  // namespace nearfield::plan
