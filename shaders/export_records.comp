#version 450
#extension GL_GOOGLE_include_directive : require

// Writes the records of resolved points, packed, in the order of the points, in three steps: one
// thread per block of points counts its records; one thread computes the prefix sums of the counts,
// which give each block's position; one thread per block writes its records. No thread waits for
// another, and the output is deterministic.

#include "export.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 2) writeonly buffer Records {
    NearfieldSummary summary;
    NearfieldRecord records[];
};

layout(std430, set = 0, binding = 3) buffer Blocks {
    RecordBlockData blocks[];
};

layout(push_constant) uniform Push { ExportRecordsPush push; };

// Depth in cells: d is half the diagonal of one.
const float touching_cells = 0.70710678 * touching_depth;
const float infinity = 1.0 / 0.0;

struct Resolved {
    bool is_record;
    bool inside;
    bool penetrates;
    bool touches;
    float distance;  // cells
    vec2 offset;     // from the point to the nearest, cells
    uint point;      // position in the tables
};

Resolved resolved_at(uint index) {
    uint word = words[push.word + index];
    uint detail = push.details + words_of_details * index;
    Resolved resolved;
    resolved.offset = uintBitsToFloat(uvec2(words[detail], words[detail + 1u]));
    resolved.distance = length(resolved.offset);
    resolved.touches = resolved.distance <= touching;
    resolved.inside = (word & nearfield_inside_flag) != 0u && !resolved.touches;
    resolved.penetrates = resolved.inside && resolved.distance > touching_cells;
    resolved.is_record = (word & point_resolved) != 0u &&
                         (push.nearby < 0.0 ? resolved.penetrates
                                            : resolved.distance * push.cell <= push.nearby);
    resolved.point = push.points + words_of_point * index;
    return resolved;
}

vec2 position_of(Resolved resolved) {
    return uintBitsToFloat(uvec2(tables[resolved.point], tables[resolved.point + 1u]));
}

void count_records(uint block, uint begin, uint end) {
    RecordBlockData found = RecordBlockData(0u, 0u, -infinity, 0u, vec2(infinity), vec2(-infinity));
    for (uint i = begin; i < end; ++i) {
        Resolved resolved = resolved_at(i);
        if (resolved.is_record) {
            float depth = (resolved.penetrates ? resolved.distance : -resolved.distance) * push.cell;
            if (depth > found.depth) {
                found.depth = depth;
                found.deepest = found.count;
            }
            vec2 point = position_of(resolved);
            found.low = min(found.low, point);
            found.high = max(found.high, point);
            ++found.count;
        }
    }
    blocks[block] = found;
}

void place_blocks() {
    NearfieldSummary all = NearfieldSummary(0u, push.capacity, nearfield_no_record, -infinity,
                                            vec2(infinity), vec2(-infinity));
    for (uint i = 0u; i < push.block_count; ++i) {
        RecordBlockData block = blocks[i];
        blocks[i].count = all.count;
        if (block.count > 0u && block.depth > all.depth) {
            all.depth = block.depth;
            all.deepest = all.count + block.deepest;
        }
        all.low = min(all.low, block.low);
        all.high = max(all.high, block.high);
        all.count += block.count;
    }
    if (all.count == 0u) {
        all.depth = 0.0;
        all.low = vec2(0.0);
        all.high = vec2(0.0);
    }
    summary = all;
}

uint feature_of(uint word, float along) {
    uint edge = word & nearfield_index_mask;
    if (along <= 0.0) {
        return nearfield_vertex_flag | edge;
    }
    if (along >= 1.0) {
        return nearfield_vertex_flag | next_vertex(edge, push.rings, push.ring_count);
    }
    return edge;
}

vec2 unit(vec2 way) {
    float size = length(way);
    return size > 0.0 ? way / size : vec2(0.0);
}

vec2 normal_of(Resolved resolved, vec2 wall) {
    if ((push.flags & nearfield_on_b_flag) != 0u) {
        return unit(unpackSnorm2x16(tables[resolved.point + 2u]));
    }
    if (resolved.touches) {
        return unit(wall);
    }
    return (resolved.inside ? resolved.offset : -resolved.offset) / resolved.distance;
}

void write_records(uint place, uint begin, uint end) {
    for (uint i = begin; i < end; ++i) {
        Resolved resolved = resolved_at(i);
        if (resolved.is_record) {
            uint word = words[push.word + i];
            uint detail = push.details + words_of_details * i;
            vec2 point = position_of(resolved);
            uint feature = feature_of(word, uintBitsToFloat(words[detail + 2u])) |
                           (word & nearfield_unique_flag) |
                           (resolved.penetrates ? nearfield_inside_flag : 0u);
            records[place++] = NearfieldRecord(
                point, point + push.cell * resolved.offset,
                normal_of(resolved, unpackSnorm2x16(words[detail + 3u])),
                push.cell * resolved.distance, feature,
                push.flags | (resolved.touches ? nearfield_touching_flag : 0u),
                tables[resolved.point + 3u]);
        }
    }
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (push.step == place_step) {
        if (index == 0u) {
            place_blocks();
        }
        return;
    }
    if (index >= push.block_count) {
        return;
    }
    uint begin = index * points_per_block;
    uint end = min(begin + points_per_block, push.point_count);
    if (push.step == count_step) {
        count_records(push.first_block + index, begin, end);
    } else {
        write_records(blocks[push.first_block + index].count, begin, end);
    }
}
