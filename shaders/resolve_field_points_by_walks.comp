#version 450
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require

// The data from which the host reconstructs a field at a point: as resolve_field_points.comp, but by
// walks over B's boxes in place of images. One thread per word: for the feature at a point, or for the
// value of a cell around it.

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
#include "around.glsl"

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint words = 1u + push.cells_per_point;
    uint i = index % words;
    uvec4 point = unit_at(push.points + index / words);
    FieldTileData tile = tile_at(point.z);
    Shape shape = shape_at(tile.b.shape);
    vec2 position = uintBitsToFloat(point.xy);
    if (i > 0u) {
        position = vec2(ivec2(unpacked(point.w)) + around[i - 1u]) + 0.5;
    }
    Place place = place_at(tile, position);
    uint turns = 0u;
    Nearest nearest = find_nearest(tile, shape, place, turns);
    uint longest = turns;
    turns = 0u;
    bool inside = find_inside(tile, shape, place, turns);
    longest = max(longest, turns);
    uint word = floatBitsToUint(inside ? -nearest.distance : nearest.distance);
    if (i == 0u) {
        turns = 0u;
        bool rival = find_rival(tile, shape, place, nearest, turns);
        longest = max(longest, turns);
        word = feature_word(number_of(shape, nearest.edge), rival, inside, 0u);
    }
    field.words[push.first_word + index / words * push.words_per_point + i] = word;
    if (longest >= max_walk_turns) {
        atomicAdd(long_searches, 1u);
    }
}
