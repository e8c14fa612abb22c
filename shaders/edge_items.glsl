// The edges that the search's first step has counted. Include after search.glsl.

struct Item {
    uint direction;
    uint slot;  // of the edge of A
};

// The edge with this number among all.
Item item_of(uint index) {
    uint block = block_of(index, push.item_blocks, item_count());
    uint rest = index - scratch[push.item_blocks + block];
    uint low = block * search_block;
    low += last_at_most(rest, push.item_words + low, min(search_block, item_count() - low), 1u, 8u);
    uint word = scratch[push.item_words + low];
    uint mask = word & 255u;
    for (uint skip = rest - (word >> 8); skip > 0u; --skip) {
        mask &= mask - 1u;
    }
    uint direction = direction_of(low);
    uvec4 shapes = direction_unit(direction, 1u);
    uint chunk = chunk_along_rings(shape_at(shapes.x), low - shapes.w);
    return Item(direction, chunk_size * chunk + findLSB(mask));
}
