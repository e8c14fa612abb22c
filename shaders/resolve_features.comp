#version 450
#extension GL_GOOGLE_include_directive : require

// The nearest feature at every cell of a field, from the segments of the cell's block. A thread has
// four cells above each other, so that each segment read serves four.

#include "fields.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) readonly buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 1) readonly buffer ScratchUnits {
    uvec4 scratch_units[];  // the same memory
};
layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;

#include "feature_words.glsl"

const uint rows_per_thread = 4u;
const uint threads_per_feature_block = block_side * block_side / rows_per_thread;

// Of four cells: the ways to the nearest points of a segment, and where these are, -1 at the segment's
// start, 1 at its end.
struct Ways {
    vec4 x;
    vec4 y;
    vec4 along;
    vec4 squared;
};

Ways ways_to(uint unit, float x, vec4 y) {
    vec4 segment = uintBitsToFloat(scratch_units[unit]);
    float squared = dot(segment.zw, segment.zw);
    float inverse = squared > 0.0 ? 1.0 / squared : 0.0;
    vec4 along = ((x - segment.x) * segment.z + (y - segment.y) * segment.w) * inverse;
    along = squared > 0.0 ? clamp(along, -1.0, 1.0) : vec4(-1.0);
    vec4 way_x = segment.x - x + along * segment.z;
    vec4 way_y = segment.y - y + along * segment.w;
    return Ways(way_x, way_y, along, way_x * way_x + way_y * way_y);
}

struct NearestOfFour {
    Ways ways;
    uvec4 edge;  // places in the list
};

NearestOfFour find_nearest(uint first, uint count, float x, vec4 y) {
    NearestOfFour nearest =
        NearestOfFour(Ways(vec4(0.0), vec4(0.0), vec4(0.0), vec4(infinity)), uvec4(0u));
    for (uint i = 0u; i < count; ++i) {
        Ways ways = ways_to(first + i, x, y);
        bvec4 nearer = lessThan(ways.squared, nearest.ways.squared);
        nearest.ways.x = mix(nearest.ways.x, ways.x, nearer);
        nearest.ways.y = mix(nearest.ways.y, ways.y, nearer);
        nearest.ways.along = mix(nearest.ways.along, ways.along, nearer);
        nearest.ways.squared = min(ways.squared, nearest.ways.squared);
        nearest.edge = mix(nearest.edge, uvec4(i), nearer);
    }
    return nearest;
}

// As is_rival().
bvec4 find_rivals(FieldTileData tile, uint first, uint count, float x, vec4 y,
                  NearestOfFour nearest) {
    vec4 size = sqrt(nearest.ways.squared);
    vec4 margin = max(vec4(tile.margin), relative_margin * size);
    vec4 limit = size + margin;
    vec4 along_wall = margin * (limit + size);
    bvec4 rivals = bvec4(false);
    for (uint i = 0u; i < count; ++i) {
        Ways ways = ways_to(first + i, x, y);
        vec4 apart_x = ways.x - nearest.ways.x;
        vec4 apart_y = ways.y - nearest.ways.y;
        bvec4 near = lessThanEqual(ways.squared, limit * limit);
        bvec4 apart = greaterThan(apart_x * apart_x + apart_y * apart_y, 4.0 * along_wall);
        rivals = bvec4(uvec4(rivals) | (uvec4(near) & uvec4(apart)));
    }
    return rivals;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint number = index / threads_per_feature_block;
    FieldTileData tile = tile_at(tile_of(number, by_block));
    uvec2 low = block_side * place_of(tile, number - tile.first_block, block_side);
    uint thread = index % threads_per_feature_block;
    uvec2 in_block = uvec2(thread % block_side, thread / block_side * rows_per_thread);
    uvec2 cell = low + in_block;
    uint next = scratch[push.blocks + 2u * number];
    uint first = push.segments + next;
    uint count = scratch[push.blocks + 2u * number + 1u];
    uvec2 size = unpacked(tile.b.size);
    if (tile.first_feature == not_asked || count == crowded ||
        any(greaterThanEqual(cell, size))) {
        return;
    }
    float x = float(in_block.x) + 0.5;
    vec4 y = float(in_block.y) + vec4(0.5, 1.5, 2.5, 3.5);
    NearestOfFour nearest = find_nearest(first, count, x, y);
    bvec4 rivals = find_rivals(tile, first, count, x, y, nearest);
    for (uint i = 0u; i < rows_per_thread && cell.y + i < size.y; ++i) {
        uint edge = scratch[push.numbers + next + nearest.edge[i]];
        float along = nearest.ways.along[i];
        uint vertex = along <= -1.0 ? first_vertex_flag : (along >= 1.0 ? last_vertex_flag : 0u);
        field.words[tile.first_feature + (cell.y + i) * size.x + cell.x] =
            feature_word(edge, rivals[i], is_filled(tile, cell + uvec2(0u, i)), vertex);
    }
}
