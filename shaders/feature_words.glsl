// The words of a field's cells: sign from the fill's mask, feature and flags. Include after
// fields.glsl; the shader declares scratch[].

bool is_filled(FieldTileData tile, uvec2 cell) {
    uint words_per_row = (unpacked(tile.b.size).x + 31u) / 32u;
    return (scratch[tile.b.mask + cell.y * words_per_row + cell.x / 32u] & (1u << (cell.x & 31u))) != 0u;
}

// The nearest edge to a cell's centre.
struct Nearest {
    float distance;
    vec2 point;  // relative to the centre
    uint edge;   // its number, or place in a list
    uint vertex;  // flag of the edge's vertex that is nearest, or 0
};

const Nearest nothing_near = Nearest(infinity, vec2(0.0), 0u, 0u);

float margin_of(FieldTileData tile, float distance) {
    return max(tile.margin, relative_margin * distance);
}

uint feature_word(uint edge, bool has_rival, bool inside, uint vertex) {
    return (inside ? point_inside : 0u) | edge |
           (push.resident != 0u ? vertex : 0u) | (has_rival ? 0u : point_unique);
}
