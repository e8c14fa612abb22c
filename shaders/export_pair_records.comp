#version 450
#extension GL_GOOGLE_include_directive : require

// What stays on the device of the pairs of a world, one thread per point that was found.

#include "nearfield/nearfield.glsl"
#include "search.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) readonly buffer Found {
    uvec4 found[];  // direction, edge of A, sample on it, word
};
layout(std430, set = 0, binding = 3) writeonly buffer Records {
    NearfieldPairRecord records[];
};

uint first_edge_along_rings(Shape shape, uint place) {
    return word_at(shape.infos + chunk_along_rings(shape, place)) >> 4;
}

vec4 ends_of(Shape shape, uint edge) {
    uint place = 0u;
    uint count = shape.chunks;
    while (count > 1u) {
        uint half_count = count / 2u;
        bool is_before = first_edge_along_rings(shape, place + half_count) <= edge;
        place += is_before ? half_count : 0u;
        count = is_before ? count - half_count : half_count;
    }
    uint chunk = chunk_along_rings(shape, place);
    uint slot = chunk_size * chunk + edge - (word_at(shape.infos + chunk) >> 4);
    return floats_at(shape.edges + slot);
}

// As search_points.comp has it, in B's frame.
vec2 point_of(SearchDirectionData direction, uvec4 record) {
    vec4 edge = ends_of(shape_at(direction.shape_a), record.y);
    vec2 from = placed(direction, edge.xy);
    vec2 end = placed(direction, edge.zw);
    return from + float(record.z) / float(parts_of(direction, record.y)) * (end - from);
}

void main() {
    uint index = dispatched_index();
    if (index >= scratch[record_total]) {
        return;
    }
    uvec4 record = found[index];
    SearchDirectionData direction = direction_at(record.x);
    float touching_depth_of_b = uintBitsToFloat(direction_unit(record.x, 3u).y);
    vec4 frame = uintBitsToFloat(scratch_unit(push.range_units + record.x));
    mat2 to_world = mat2(frame.x, frame.y, -frame.y, frame.x);
    vec2 p = point_of(direction, record);
    vec4 edge = ends_of(shape_at(direction.shape_b), record.w & point_edge_mask);
    vec2 nearest = nearest_on_segment(p, edge.xy, edge.zw);
    vec2 way = to_world * (nearest - p);
    float size = length(nearest - p);
    float distance = length(way);
    bool is_inside = (record.w & point_inside) != 0u;
    bool touches = size <= 2.0 * direction.margin;
    bool is_unfinished = uintBitsToFloat(scratch_word(push.record_depths + index)) < 0.0;
    uint feature = record.w & point_edge_mask;
    feature |= (record.w & point_unique) != 0u ? nearfield_unique_flag : 0u;
    feature |= is_inside && size > touching_depth_of_b ? nearfield_inside_flag : 0u;
    uint flags = touches ? nearfield_touching_flag : 0u;
    bool is_doubtful = is_unfinished || (record.w & point_doubtful) != 0u;
    flags |= is_doubtful ? nearfield_undecided_flag : 0u;
    records[index] = NearfieldPairRecord(
        to_world * p + frame.zw, to_world * nearest + frame.zw,
        touches ? vec2(0.0) : (is_inside ? way : -way) / distance, distance, feature, record.y, flags);
}
