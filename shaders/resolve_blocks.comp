#version 450
#extension GL_GOOGLE_include_directive : require

// What is asked for at every cell of a field, from the lists of the blocks: signed distance (section
// 2.2.2 of the paper), nearest feature. One thread a column of a block.

#define BLOCKS_ACCESS readonly
#include "layout.glsl"
#include "nearest.glsl"
#include "blocks.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;

layout(push_constant) uniform Push {
    uint first;   // column of a block
    uint end;
    uint blocks;  // where they start in the geometry array
    uint lists;   // where their lists start in the scratch memory
} push;

struct List {
    uint first;  // in the scratch memory
    uint count;
    bool whole;  // there was no room: the list of the part counts
};

uint place_in_part(List list, uint i) {
    return list.whole ? i : scratch[list.first + i];
}

void consider_edge(vec2 from_a, vec2 d, float inverse, vec4 rows, inout vec4 squared) {
    vec4 y = from_a.y + rows;
    vec4 t = clamp((from_a.x * d.x + y * d.y) * inverse, 0.0, 1.0);
    vec4 away_x = from_a.x - t * d.x;
    vec4 away_y = y - t * d.y;
    squared = min(squared, away_x * away_x + away_y * away_y);
}

const vec4 low_rows = vec4(0.0, 1.0, 2.0, 3.0);
const vec4 high_rows = vec4(4.0, 5.0, 6.0, 7.0);

void write_values(Tile part, List list, uvec2 corner, uint rows, uint word) {
    vec4 low = vec4(infinity);
    vec4 high = vec4(infinity);
    vec2 p = vec2(corner) + 0.5;
    for (uint i = 0u; i < list.count; ++i) {
        uint edge = part.nearest.edges + 4u * place_in_part(list, i);
        vec2 a = geometry[edge];
        vec2 d = geometry[edge + 1u] - a;
        float squared = dot(d, d);
        float inverse = squared > 0.0 ? 1.0 / squared : 0.0;
        consider_edge(p - a, d, inverse, low_rows, low);
        consider_edge(p - a, d, inverse, high_rows, high);
    }
    low = sqrt(low);
    high = sqrt(high);
    uvec2 in_tile = corner + uvec2(part.atlas_x, part.atlas_y);
    for (uint row = 0u; row < rows; ++row) {
        float value = row < 4u ? low[row] : high[row - 4u];
        bool inside = filled_at(part, in_tile + uvec2(0u, row));
        field.words[word + row * part.tile_width] = floatBitsToUint(inside ? -value : value);
    }
}

uint feature_at(Tile part, List list, vec2 p, uvec2 cell) {
    Nearest nearest = nothing_near;
    for (uint i = 0u; i < list.count; ++i) {
        Edge edge = list_edge(part.nearest, place_in_part(list, i));
        if (distance_to_segment(p, edge.a, edge.b) - edge.deviation < nearest.distance) {
            consider_run(p, edge, nearest);
        }
    }
    float margin = rival_margin(part, nearest);
    bool rival = false;
    for (uint i = 0u; i < list.count && !rival; ++i) {
        Edge edge = list_edge(part.nearest, place_in_part(list, i));
        rival = distance_to_segment(p, edge.a, edge.b) - edge.deviation <=
                    nearest.distance + margin &&
                run_has_rival(p, edge, nearest, margin);
    }
    return feature_word(part, p, cell, nearest, rival);
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint block_index = index / block_side;
    Block block = block_at(push.blocks + block_index);
    Tile part = tiles[block.part];
    uvec2 corner = block.corner + uvec2(index % block_side, 0u);
    if (corner.x >= part.width) {
        return;
    }
    uint rows = min(block_side, part.height - corner.y);
    uint start = push.lists + block_words * block_index;
    uint count = scratch[start];
    bool whole = count > block_capacity;
    List list = List(start + 1u, whole ? part.nearest.count : count, whole);
    uvec2 in_tile = corner + uvec2(part.atlas_x, part.atlas_y);
    uint cell = in_tile.y * part.tile_width + in_tile.x;
    if (part.first_value != not_asked) {
        write_values(part, list, corner, rows, part.first_value + cell);
    }
    if (part.first_feature != not_asked) {
        for (uint row = 0u; row < rows; ++row) {
            field.words[part.first_feature + cell + row * part.tile_width] =
                feature_at(part, list, vec2(corner + uvec2(0u, row)) + 0.5,
                           in_tile + uvec2(0u, row));
        }
    }
}
