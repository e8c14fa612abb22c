#version 450
#extension GL_GOOGLE_include_directive : require

// The search's second step, one thread per item: its edges that can have points that are asked for,
// one after the other.

#include "search.glsl"

layout(local_size_x = group_size) in;

void main() {
    uint item = push.first + dispatched_index();
    if (item >= item_count()) {
        return;
    }
    uint word = scratch_word(push.item_words + words_of_item * item);
    uint direction = scratch_word(push.item_words + words_of_item * item + 1u);
    uvec4 shapes = direction_unit(direction, 1u);
    uint slot = chunk_size * chunk_along_rings(shape_at(shapes.x), item - shapes.w);
    uint target = (word >> 8) + scratch_word(push.item_blocks + item / search_block);
    uint end = scratch[edge_total];
    for (uint mask = word & 255u; mask != 0u && target < end; ++target) {
        scratch_units[push.edge_units + units_of_edge * target] =
            uvec4(direction, slot + take_bit(mask), 0u, 0u);
    }
}
