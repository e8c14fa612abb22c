// The nearest of B's own edges to points of fields, by lists of near edges
// (engine/plan/compute_work.hpp): blocks of tiles stand for tiles. Stands after nearest.glsl.

layout(std430, set = 0, binding = 2) readonly buffer Scratch {
    uint scratch[];  // masks
};

const uint block_side = 16u;
const uint not_asked = 0xffffffffu;

// Two distances that single precision cannot tell apart far from B.
const float relative_margin = 1.0 / 262144.0;

// Whether a cell of the tile that a block belongs to lies inside.
bool filled_at(Tile block, uvec2 cell) {
    uint words_per_row = (block.tile_width + 31u) / 32u;
    return (scratch[block.mask + cell.y * words_per_row + cell.x / 32u] & (1u << (cell.x & 31u))) !=
           0u;
}

// What nearest.glsl's search says of a point in a cell: one word, as plan::point_inside and so on
// say.
uint feature_at(Tile block, vec2 p, uvec2 cell, out Nearest nearest) {
    nearest = find_nearest(p, block.nearest, nothing_near);
    float margin = max(block.margin, relative_margin * nearest.distance);
    bool rival = has_rival(p, block.nearest, nearest, margin);
    // Close to the boundary the mask, which is of a simplified and snapped one, may be off.
    bool inside = nearest.distance > block.settled ? filled_at(block, cell)
                                                   : inside_by_crossings(p, block.crossing);
    return (inside ? inside_flag : 0u) | (rival ? 0u : unique_flag) | nearest.edge;
}
