#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require

// The values and features of a field in crowded blocks, one thread per cell.

#include "fields.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) readonly buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 2) buffer LongSearches {
    uint long_searches;  // their number
};
layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;

#include "feature_words.glsl"
#include "field_walks.glsl"

void main() {
    uint number = scratch[push.crowd + gl_WorkGroupID.x];
    FieldTileData tile = tile_at(tile_of(number, by_block));
    Shape shape = shape_at(tile.b.shape);
    uint index = gl_WorkGroupID.y * group_size + gl_LocalInvocationID.x;
    uvec2 cell = block_side * place_of(tile, number - tile.first_block, block_side) +
                 uvec2(index % block_side, index / block_side);
    uvec2 size = unpacked(tile.b.size);
    if (any(greaterThanEqual(cell, size))) {
        return;
    }
    Place place = place_at(tile, vec2(cell) + 0.5);
    uint turns = 0u;
    Nearest nearest = find_nearest(tile, shape, place, turns);
    bool inside = is_filled(tile, cell);
    uint word = cell.y * size.x + cell.x;
    if (tile.first_value != not_asked) {
        field.words[tile.first_value + word] =
            floatBitsToUint(inside ? -nearest.distance : nearest.distance);
    }
    bool too_long = turns >= max_walk_turns;
    if (tile.first_feature != not_asked) {
        turns = 0u;
        bool rival = find_rival(tile, shape, place, nearest, turns);
        too_long = too_long || turns >= max_walk_turns;
        field.words[tile.first_feature + word] =
            feature_word(number_of(shape, nearest.edge), rival, inside, nearest.vertex);
    }
    if (too_long) {
        atomicAdd(long_searches, 1u);
    }
}
