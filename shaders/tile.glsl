// For fragments of meshes that carry the rectangle of their tile.

layout(location = 1) flat in uvec4 tile_rectangle;  // low corner in the atlas, then size

// The fragment's cell in the tile; huge left of it or below.
uvec2 cell_in_tile() {
    return uvec2(gl_FragCoord.xy) - tile_rectangle.xy;
}

void discard_outside_tile() {
    if (any(greaterThanEqual(cell_in_tile(), tile_rectangle.zw))) {
        discard;
    }
}
