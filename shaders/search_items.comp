#version 450
#extension GL_GOOGLE_include_directive : require

// The search's first step, one thread per item, which is a chunk of A's edges in one direction:
// which of these edges can have points that are asked for.

#include "search.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"
#include "totals.glsl"
#include "scan.glsl"

uint edges_of(uint item, uint direction_index) {
    SearchDirectionData direction = direction_at(direction_index);
    Shape a = shape_at(direction.shape_a);
    uint chunk = chunk_along_rings(a, item - direction.first_item);
    float grow = direction.reach + 2.0 * direction.margin;
    vec4 near = box_of_shape(direction.shape_b) + vec4(-grow, -grow, grow, grow);
    vec4 box = floats_at(word_at(a.first_boxes) + chunk);
    if (!do_overlap(turned_box(box, rotation_of(direction), direction.offset, 0.0), near)) {
        return 0u;
    }
    // Of pairs of contacts, the edges without samples may cross B's too.
    bool crosses = (push.flags & search_crosses) != 0u && direction.outside != 0.0;
    uint info = word_at(a.infos + chunk);
    uint mask = 0u;
    vec4 next = floats_at(a.edges + chunk_size * chunk);
    for (uint i = 0u; i < (info & 15u); ++i) {
        vec4 edge = next;
        next = floats_at(a.edges + chunk_size * chunk + i + 1u);
        vec2 from = placed(direction, edge.xy);
        vec2 to = placed(direction, edge.zw);
        if (do_overlap(vec4(min(from, to), max(from, to)), near) &&
            (crosses || parts_of(direction, (info >> 4) + i) > 0u)) {
            mask |= 1u << i;
        }
    }
    return mask;
}

void main() {
    uint item = push.first + dispatched_index();
    bool exists = item < item_count();
    uint direction = exists ? direction_of(item) : 0u;
    uint mask = exists ? edges_of(item, direction) : 0u;
    uint before = sum_before(bitCount(mask), push.block_sums + item / search_block);
    if (exists) {
        scratch[push.item_words + words_of_item * item] = mask | before << 8;
        scratch[push.item_words + words_of_item * item + 1u] = direction;
    }
    scan(push.item_blocks, item_count());
}
