// Fields by lists of near edges (engine/plan/compute_work.hpp): parts of tiles stand for tiles, and
// behind the lists in the geometry array stand blocks of 8 x 8 cells. Stands after nearest.glsl.

layout(std430, set = 0, binding = 2) BLOCKS_ACCESS buffer Scratch {
    uint scratch[];  // masks, and a list by block: how many edges, then their places
};

const uint block_side = 8u;
const uint block_capacity = 127u;
const uint block_words = 1u + block_capacity;
const uint not_asked = 0xffffffffu;

// Two distances that single precision cannot tell apart far from B.
const float relative_margin = 1.0 / 262144.0;

struct Block {
    uint part;
    uvec2 corner;  // its low cell, within the part
};

Block block_at(uint index) {
    vec2 words = geometry[index];
    uint corner = floatBitsToUint(words.y);
    return Block(floatBitsToUint(words.x), uvec2(corner & 0xffffu, corner >> 16));
}

// Whether a cell, given in the tile that a part belongs to, lies inside.
bool filled_at(Tile part, uvec2 cell) {
    uint words_per_row = (part.tile_width + 31u) / 32u;
    return (scratch[part.mask + cell.y * words_per_row + cell.x / 32u] & (1u << (cell.x & 31u))) !=
           0u;
}

// What nearest.glsl's search says, once it has found the nearest edge of a point in a cell.
uint feature_word(Tile part, vec2 p, uvec2 cell, Nearest nearest, bool rival) {
    // Close to the boundary the mask, which is of a simplified and snapped one, may be off.
    bool inside = nearest.distance > part.settled ? filled_at(part, cell)
                                                  : inside_by_crossings(p, part.crossing);
    return (inside ? inside_flag : 0u) | (rival ? 0u : unique_flag) | vertex_flags(nearest) |
           nearest.edge;
}

float rival_margin(Tile part, Nearest nearest) {
    return max(part.margin, relative_margin * nearest.distance);
}
