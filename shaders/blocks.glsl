// The nearest of B's own edges at cells and points of fields, from lists of near edges
// (engine/plan/compute_work.hpp). Each Tile is a block of a field tile. Include after nearest.glsl.

layout(std430, set = 0, binding = 2) readonly buffer Scratch {
    uint scratch[];  // bit masks
};

const uint block_side = 16u;
const uint not_asked = 0xffffffffu;

// Relative difference of two distances far from B that single precision cannot resolve.
const float relative_margin = 1.0 / 262144.0;

// Whether a cell of the block's field tile is set in its fill mask.
bool filled_at(Tile block, uvec2 cell) {
    uint words_per_row = (block.tile_width + 31u) / 32u;
    return (scratch[block.mask + cell.y * words_per_row + cell.x / 32u] & (1u << (cell.x & 31u))) !=
           0u;
}

// The nearest feature of a point in a cell as one word (plan::point_inside and the other flags).
uint feature_at(Tile block, vec2 p, uvec2 cell, out Nearest nearest) {
    nearest = find_nearest(p, block.nearest, nothing_near);
    float margin = max(block.margin, relative_margin * nearest.distance);
    bool rival = has_rival(p, block.nearest, nearest, margin);
    // The mask is that of a simplified and snapped boundary: close to the boundary it can be wrong.
    bool inside = nearest.distance > block.settled ? filled_at(block, cell)
                                                   : inside_by_crossings(p, block.crossing);
    return (inside ? inside_flag : 0u) | (rival ? 0u : unique_flag) | nearest.edge;
}
