#pragma once

#include <engine/device_input/compute_work.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/device_input/shapes_in_tiles.hpp>
#include <engine/device_input/tile_batch.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// A tile batch of the compute technique.
struct ComputeBatch : TileBatch {
    ComputeWork work;
    bool keeps_hits = false;  ///< there are overlap tiles whose hits are kept
    bool resident = false;    ///< there are fields that stay on the device

    void clear();
};

/// Divides the tiles of the compute technique among tile batches, and turns those of each into its
/// work: masks and fields. Keeps its scratch memory.
class ComputeBatchBuilder {
public:
    /// Replaces the first tile batches; returns their number. Each takes as many cells as an atlas
    /// image has, which bounds the memory for masks and lists. `largest_range`: bytes that a shader
    /// can address.
    [[nodiscard]] std::uint32_t build(const Plan& plan, std::uint64_t largest_range,
                                      std::vector<ComputeBatch>& batches);

private:
    [[nodiscard]] std::uint32_t build_all(const Plan& plan, std::vector<ComputeBatch>& batches);
    void add_tile(const PlannedQuery& query, const PlannedTile& tile, ComputeBatch& batch);
    /// Adds a field tile. `field` says where in the read-back the requested outputs go.
    void add_field_tile(const PlannedQuery& query, const PlannedTile& tile, const FieldTile& field,
                        ComputeWork& work);
    /// Adds an overlap tile. `asked` says whether each shape takes part by its volume or its
    /// boundary.
    void add_overlap_tile(const PlannedQuery& query, const PlannedTile& tile,
                          const OverlapTile& asked, ComputeWork& work);
    /// Adds a shape with a mask of a tile. `reach`, `first_edge`: see MaskShapeData.
    void add_mask_shape(const shaders::ShapeInTileData& seen, const PlannedTile& tile, double reach,
                        std::uint32_t first_edge, ComputeWork& work) const;

    ShapesInTiles shapes_;
    struct TileOfBatch {
        std::uint32_t batch = 0;
        std::uint32_t field_tile = 0;  // among the field tiles of the batch
    };
    std::vector<TileOfBatch> tile_of_plan_;  // by tile of the plan
};

}  // namespace nearfield::device_input
