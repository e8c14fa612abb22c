#pragma once

#include <engine/plan/compute_work.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/shapes_in_tiles.hpp>

#include <cstdint>

namespace nearfield::plan {

struct FieldTile;
struct OverlapTile;

/// Turns the tiles of a tile batch of the compute technique into its work: masks, fields, lists of
/// near edges. Keeps its scratch memory.
class ComputeBuilder {
public:
    /// Call first in each batch.
    void begin_batch() { shapes_.begin_batch(); }
    void forget_shapes() { shapes_.clear(); }
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
};

}  // namespace nearfield::plan
