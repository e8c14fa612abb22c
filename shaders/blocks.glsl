// The nearest of B's own edges at cells and points of fields, from lists of near edges
// (plan::ComputeWork). Each tile is a block of a field tile. Include after nearest.glsl.

#include "compute_work.h"

layout(std430, set = 0, binding = 2) readonly buffer Scratch {
    uint scratch[];  // bit masks
};

// Whether a cell of the block's field tile is set in its fill mask.
bool filled_at(TileData block, uvec2 cell) {
    uint words_per_row = (block.tile_width + 31u) / 32u;
    return (scratch[block.mask + cell.y * words_per_row + cell.x / 32u] & (1u << (cell.x & 31u))) !=
           0u;
}

// The nearest feature of a point in a cell as one word (plan::point_inside and the other flags).
uint feature_at(TileData block, vec2 p, uvec2 cell, out Nearest nearest) {
    nearest = find_nearest(p, block.nearest, nothing_near);
    float margin = max(block.margin, relative_margin * nearest.distance);
    bool rival = has_rival(p, block.nearest, nearest, margin);
    // The mask is that of a simplified and snapped boundary: close to the boundary it can be wrong.
    bool inside = nearest.distance > block.settled ? filled_at(block, cell)
                                                   : inside_by_crossings(p, block.crossing);
    return (inside ? point_inside : 0u) | (rival ? 0u : point_unique) | nearest.edge;
}
