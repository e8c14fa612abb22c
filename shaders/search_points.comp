#version 450
#extension GL_GOOGLE_include_directive : require

// The search's third step, one thread per point of A's boundary: the side of B's boundary on which
// it lies where that is not known, the nearest edge of B, and what single precision leaves in
// doubt.

#include "search.glsl"
#include "block_sum.glsl"

layout(local_size_x = 64) in;

const uint inside_flag = 1u << 31;
const uint unique_flag = 1u << 30;
const uint resolved_flag = 1u << 29;
const uint doubt_flag = 1u << 28;
const uint local_shift = 26u;

struct Nearest {
    float distance;
    vec2 point;
    uint slot;
};

uint edges_end(Shape b, uint chunk) {
    return chunk_size * chunk + (input_words[b.infos + chunk] & 15u);
}

bool is_inside(vec2 p, Shape b) {
    bool odd = false;
    Walk walk = start_walk(b);
    bool enters = true;
    for (;;) {
        if (enters) {
            walk.mask = 0u;
            uint count = boxes_of_group(b, walk.level, walk.group);
            for (uint i = 0u; i < count; ++i) {
                vec4 box = float_units[b.first_box[walk.level] + chunk_size * walk.group + i];
                walk.mask |= ray_meets(p, box) ? 1u << i : 0u;
            }
        }
        uint box;
        if (!next_box(b, walk, box)) {
            return odd;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
            continue;
        }
        for (uint i = chunk_size * box; i < edges_end(b, box); ++i) {
            vec4 edge = float_units[b.edges + i];
            odd = odd != crosses(p, edge.xy, edge.zw);
        }
    }
}

void consider_chunk(vec2 p, Shape b, uint chunk, inout Nearest nearest) {
    for (uint i = chunk_size * chunk; i < edges_end(b, chunk); ++i) {
        vec4 edge = float_units[b.edges + i];
        vec2 q = nearest_on_segment(p, edge.xy, edge.zw);
        float d = distance(p, q);
        if (d < nearest.distance) {
            nearest = Nearest(d, q, i);
        }
    }
}

// Follows the nearest box from level to level: a first bound for the search.
void descend_to_nearest(vec2 p, Shape b, inout Nearest nearest) {
    uint group = 0u;
    for (uint level = b.levels; level > 0u; --level) {
        uint count = boxes_of_group(b, level - 1u, group);
        uint best = 0u;
        float least = infinity;
        for (uint i = 0u; i < count; ++i) {
            float d = distance_to_box(
                p, float_units[b.first_box[level - 1u] + chunk_size * group + i]);
            best = d < least ? i : best;
            least = min(d, least);
        }
        group = chunk_size * group + best;
    }
    consider_chunk(p, b, group, nearest);
}

// Returns the nearest edge that is nearer than `limit`; slot is no_parts if there is none.
Nearest find_nearest(vec2 p, Shape b, float limit) {
    Nearest nearest = Nearest(limit, vec2(0.0), no_parts);
    descend_to_nearest(p, b, nearest);
    Walk walk = start_walk(b);
    bool enters = true;
    for (;;) {
        if (enters) {
            walk.mask = 0u;
            uint count = boxes_of_group(b, walk.level, walk.group);
            for (uint i = 0u; i < count; ++i) {
                vec4 box = float_units[b.first_box[walk.level] + chunk_size * walk.group + i];
                walk.mask |= distance_to_box(p, box) < nearest.distance ? 1u << i : 0u;
            }
        }
        uint box;
        if (!next_box(b, walk, box)) {
            return nearest;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
        } else {
            consider_chunk(p, b, box, nearest);
        }
    }
}

struct Rivals {
    bool unique;
    bool doubtful;
};

// A second boundary point that is as near as the nearest one, up to the margin, is a rival if it is
// more than twice as far from it as one straight edge explains. A second edge that is as near, up to
// rounding, leaves both in doubt, except for a neighbour with the same nearest point.
void compare_chunk(vec2 p, Shape b, uint chunk, Nearest nearest, uint edge, Direction direction,
                   inout Rivals rivals) {
    float limit = nearest.distance + direction.rival;
    float along_wall = direction.rival * (limit + nearest.distance);  // limit^2 - distance^2
    uint first = input_words[b.infos + chunk] >> 4;
    for (uint i = chunk_size * chunk; i < edges_end(b, chunk); ++i) {
        vec4 other = float_units[b.edges + i];
        vec2 q = nearest_on_segment(p, other.xy, other.zw);
        float d = distance(p, q);
        vec2 apart = q - nearest.point;
        if (d <= limit && dot(apart, apart) > 4.0 * along_wall) {
            rivals.unique = false;
        }
        uint number = first + i % chunk_size;
        bool elsewhere = number + 1u < edge || number > edge + 1u ||
                         dot(apart, apart) > 16.0 * direction.margin * direction.margin;
        if (d <= nearest.distance + direction.doubt && elsewhere) {
            rivals.doubtful = true;
        }
    }
}

Rivals find_rivals(vec2 p, Shape b, Nearest nearest, uint edge, Direction direction) {
    Rivals rivals = Rivals(true, false);
    float limit = nearest.distance + max(direction.rival, direction.doubt);
    Walk walk = start_walk(b);
    bool enters = true;
    for (;;) {
        if (enters) {
            walk.mask = 0u;
            uint count = boxes_of_group(b, walk.level, walk.group);
            for (uint i = 0u; i < count; ++i) {
                vec4 box = float_units[b.first_box[walk.level] + chunk_size * walk.group + i];
                walk.mask |= distance_to_box(p, box) <= limit ? 1u << i : 0u;
            }
        }
        uint box;
        if (!next_box(b, walk, box)) {
            return rivals;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
        } else {
            compare_chunk(p, b, box, nearest, edge, direction, rivals);
        }
    }
}

// The edge of A that a point lies on, as the step before has written it.
struct Owner {
    uint direction;
    uint slot;
    uint number;  // among the points of the edge
    bool asked;
};

Owner owner_of(uint index) {
    uint edges = scratch[edge_total];
    uint block = last_block(push.edge_blocks, (edges + block_size - 1u) / block_size, index);
    uint rest = index - scratch[push.edge_blocks + block];
    uint low = block * block_size;
    uint count = min(block_size, edges - low);
    while (count > 1u) {
        uint half_count = count / 2u;
        if (scratch_units[push.edge_units + 2u * (low + half_count)].w <= rest) {
            low += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    uvec4 edge = scratch_units[push.edge_units + 2u * low];
    uvec4 asked = scratch_units[push.edge_units + 2u * low + 1u];
    uint point = edge.z + rest - edge.w;
    return Owner(edge.x, edge.y, point, point >= asked.x && point < asked.y);
}

uint number_of(Shape shape, uint slot) {
    return (input_words[shape.infos + slot / chunk_size] >> 4) + slot % chunk_size;
}

uint resolve(vec2 p, bool asked, Direction direction) {
    Shape b = shape_at(direction.shape_b);
    bool inside = !asked || is_inside(p, b);
    float limit = direction.outside ? direction.reach + 2.0 * direction.margin
                  : inside          ? infinity
                                    : 2.0 * direction.margin;
    Nearest nearest = find_nearest(p, b, limit);
    if (nearest.slot == no_parts) {
        return 0u;
    }
    uint edge = number_of(b, nearest.slot);
    Rivals rivals = find_rivals(p, b, nearest, edge, direction);
    bool doubtful = rivals.doubtful || nearest.distance <= 2.0 * direction.margin;
    return resolved_flag | (inside ? inside_flag : 0u) | (rivals.unique ? unique_flag : 0u) |
           (doubtful ? doubt_flag : 0u) | edge;
}

uvec4 record_of(uint index) {
    Owner owner = owner_of(index);
    Direction direction = direction_at(owner.direction);
    Shape a = shape_at(direction.shape_a);
    vec4 edge = float_units[a.edges + owner.slot];
    uint number = number_of(a, owner.slot);
    float along = float(owner.number) / float(parts_of(direction, number));
    vec2 from = direction.rotation * edge.xy + direction.translation;
    vec2 end = direction.rotation * edge.zw + direction.translation;
    uint word = resolve(from + along * (end - from), owner.asked, direction);
    return uvec4(owner.direction, number, owner.number, word);
}

void main() {
    uint index = dispatched_index();
    bool exists = index < scratch[point_total];
    uvec4 record = uvec4(0u);
    if (exists) {
        record = record_of(index);
    }
    uint before = sum_before(record.w != 0u ? 1u : 0u, push.point_blocks + index / block_size);
    if (exists) {
        record.x |= before << local_shift;
        scratch_units[push.point_units + index] = record;
    }
}
