#version 450
#extension GL_GOOGLE_include_directive : require

// What stays on the device of the points of a world's pairs that were found, behind those of the parts
// before, a thread for as many as in search_points.comp, which threads of a workgroup take in turns.

#include "nearfield/nearfield.glsl"
#include "search.glsl"
#include "pairs.h"

layout(local_size_x = group_size) in;

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

// `record`: direction, edge of A, sample on it, word.
NearfieldPairRecord exported(uvec4 record, float depth) {
    SearchDirectionData direction = direction_at(record.x);
    vec4 frame = uintBitsToFloat(scratch_unit(push.frames + record.x));
    mat2 to_world = mat2(frame.x, frame.y, -frame.y, frame.x);
    vec2 p = point_of(direction, record);
    vec4 edge = ends_of(shape_at(direction.shape_b), record.w & point_edge_mask);
    vec2 nearest = nearest_on_segment(p, edge.xy, edge.zw);
    vec2 way = to_world * (nearest - p);
    float size = length(nearest - p);
    float distance = length(way);
    bool is_inside = (record.w & point_inside) != 0u;
    bool touches = size <= 2.0 * direction.margin;
    uint feature = record.w & point_edge_mask;
    feature |= (record.w & point_unique) != 0u ? nearfield_unique_flag : 0u;
    float touching_depth_of_b = uintBitsToFloat(direction_unit(record.x, 3u).y);
    feature |= is_inside && size > touching_depth_of_b ? nearfield_inside_flag : 0u;
    uint flags = touches ? nearfield_touching_flag : 0u;
    bool is_doubtful = depth < 0.0 || (record.w & point_doubtful) != 0u;
    flags |= is_doubtful ? nearfield_undecided_flag : 0u;
    return NearfieldPairRecord(
        to_world * p + frame.zw, to_world * nearest + frame.zw,
        touches ? vec2(0.0) : (is_inside ? way : -way) / distance, distance, feature, record.y, flags);
}

void main() {
    uint block = dispatched_index() / search_block;
    uint before = scratch_word(push.point_blocks + block);
    uint of_parts = scratch[records_so_far] - scratch[record_total];
    uint first = points_per_thread * search_block * block + gl_LocalInvocationID.x;
    for (uint i = 0u; i < points_per_thread; ++i) {
        uint point = first + search_block * i;
        if (point >= scratch[point_total]) {
            return;
        }
        uvec4 record = scratch_unit(push.point_units + point);
        uint target = before + (record.x >> local_shift);
        record.x &= (1u << local_shift) - 1u;
        if (record.w != 0u && target < scratch[record_total]) {
            records[of_parts + target] =
                exported(record, uintBitsToFloat(scratch_word(push.depths + point)));
        }
    }
}
