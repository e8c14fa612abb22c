#version 450
#extension GL_GOOGLE_include_directive : require

// Copies the resolved cells of a field tile to the resident images: the signed distance in world
// units and, where it is asked for, the nearest feature as an id. The thread of the field's first cell
// also writes its header.

#include "export.glsl"
#include "header.glsl"

layout(local_size_x = field_group_side, local_size_y = field_group_side) in;

layout(set = 0, binding = 6, r32f) writeonly uniform image2D signed_distance;
layout(set = 0, binding = 7, r32ui) writeonly uniform uimage2D feature_id;

layout(std430, set = 0, binding = 3) writeonly buffer Header {
    NearfieldHeader header;
};

layout(push_constant) uniform Push { ExportFieldPush push; };

uint id_of(uint word) {
    uint edge = word & nearfield_index_mask;
    uint flags = word & (nearfield_unique_flag | nearfield_inside_flag);
    if ((word & first_vertex_flag) != 0u) {
        return flags | nearfield_vertex_flag | edge;
    }
    if ((word & last_vertex_flag) != 0u) {
        return flags | nearfield_vertex_flag | next_vertex(edge, push.rings, push.ring_count);
    }
    return flags | edge;
}

void main() {
    uvec2 cell = gl_GlobalInvocationID.xy;
    if (cell.x >= push.width || cell.y >= push.height) {
        return;
    }
    uint offset = cell.y * push.stride + cell.x;
    ivec2 texel = ivec2(push.column, push.row) + ivec2(cell);
    if (texel == ivec2(0)) {
        header = header_of_field(uvec2(push.field_width, push.field_height), push.origin, push.cell);
    }
    float value = uintBitsToFloat(words[push.value + offset]);
    imageStore(signed_distance, texel, vec4(value * push.cell));
    if (push.feature != not_asked) {
        imageStore(feature_id, texel, uvec4(id_of(words[push.feature + offset])));
    }
}
