#version 450
#extension GL_GOOGLE_include_directive : require

// The search's fourth step, one thread per direction: its edges, and how many of the threads of the
// next step its points take. No thread has points of two directions.

#include "search.glsl"
#include "block_sum.glsl"

layout(local_size_x = group_size) in;

// The edges of the items before one, or of all.
uint edges_before(uint item) {
    uint total = scratch[edge_total];
    return item < item_count()
               ? min(scratch_word(push.item_blocks + item / search_block) +
                         (scratch_word(push.item_words + words_of_item * item) >> 8),
                     total)
               : total;
}

void main() {
    uint direction = push.first + dispatched_index();
    bool exists = direction < direction_count();
    uint first_edge = 0u;
    uint end_edge = 0u;
    uint points = 0u;
    if (exists) {
        first_edge = edges_before(direction_unit(direction, 1u).w);
        end_edge = direction + 1u < direction_count()
                       ? edges_before(direction_unit(direction + 1u, 1u).w)
                       : scratch[edge_total];
        uint end = end_edge < scratch[edge_total] ? points_before(end_edge)
                                                  : scratch[edge_point_total];
        points = first_edge < end_edge ? end - points_before(first_edge) : 0u;
    }
    uint threads = (points + points_per_thread - 1u) / points_per_thread;
    uint before =
        sum_before(points_per_thread * threads, push.range_blocks + direction / search_block);
    if (exists) {
        scratch_units[push.range_units + direction] = uvec4(before, first_edge, end_edge, points);
    }
}
