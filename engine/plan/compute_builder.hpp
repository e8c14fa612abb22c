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

struct Round;
struct TileDraw;

/// Turns the tiles of a round of the compute technique into its work: masks, lists of near edges,
/// blocks. Keeps its scratch memory.
class ComputeBuilder {
public:
    explicit ComputeBuilder(geometry::SubpixelGrid grid) : grid_(grid) {}

    /// Of a tile of boundary points: its lists.
    void add_points_tile(const PlannedQuery& query, const Tile& tile, SimplifiedShapes& shapes,
                         TileData& data, Round& round);
    /// Of a field tile: the mask, and its blocks with their lists. `draw` says where what is asked
    /// for goes in the read-back.
    void add_field_tile(const PlannedQuery& query, const Tile& tile, const TileDraw& draw,
                        SimplifiedShapes& shapes, Round& round);
    /// `draw` says by which part of it each shape takes part.
    void add_overlap_tile(const PlannedQuery& query, const Tile& tile, const TileDraw& draw,
                          SimplifiedShapes& shapes, Round& round);
    /// Of a point of a field tile that has been added; `first_block`: the tile's first one in
    /// ComputeWork::feature_blocks.
    static void add_field_point(const Tile& tile, std::uint32_t first_block,
                                const PlannedFieldPoint& point, ComputeWork& work);

private:
    [[nodiscard]] EdgeListData add_crossing(const TileBoundary& boundary, const Tile& tile,
                                            double slack, Round& round);
    void add_blocks(const TileBoundary& boundary, const Tile& tile, const MaskData& mask,
                    std::uint32_t first_value, ComputeWork& work);
    void add_feature_blocks(const PlannedQuery& query, const TileBoundary& boundary,
                            const Tile& tile, const MaskData& mask, std::uint32_t first_feature,
                            Round& round);
    /// Fills a mask with the shape whose edges are in crossing_.
    void add_fill(const Tile& tile, std::uint32_t mask, ComputeWork& work) const;
    void add_boundary(const TileBoundary& boundary, const Tile& tile, double offset,
                      std::uint32_t overlap, bool of_a, Round& round) const;

    geometry::SubpixelGrid grid_;
    NearestEdgeFinder finder_;  // of points, which lie thinly in their tile
    BlockEdges block_edges_;    // of fields
    std::vector<NearestEdge> nearest_;
    std::vector<TileEdge> nearest_list_;
    std::vector<TileEdge> crossing_;
};

}  // namespace nearfield::plan
