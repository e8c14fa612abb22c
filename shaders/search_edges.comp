#version 450
#extension GL_GOOGLE_include_directive : require

// The search's second step, one thread per edge of A that can have points that are asked for. One
// walk over B's boxes finds the sides of the edge's first and last point, and the interval of the
// points that B's boundary may separate from them, or that lie within reach of it.

#include "search.glsl"
#include "block_sum.glsl"
#include "edge_items.glsl"

layout(local_size_x = group_size) in;

// Restricts t to where a + t * d lies between low and high.
bool clip(float a, float d, float low, float high, inout vec2 t) {
    if (d == 0.0) {
        return low <= a && a <= high;
    }
    float u = (low - a) / d;
    float v = (high - a) / d;
    t = vec2(max(t.x, min(u, v)), min(t.y, max(u, v)));
    return t.x <= t.y;
}

bool clip_to_box(vec2 a, vec2 d, vec4 box, inout vec2 t) {
    return clip(a.x, d.x, box.x, box.z, t) && clip(a.y, d.y, box.y, box.w, t);
}

struct Stretch {
    vec2 near;  // the interval of the points that may be near B's boundary; empty: y < x
    bool first_inside;
    bool last_inside;
};

// The boxes of a walk's group that the stretch, or the ray from either end, may meet.
void enter(inout Walk walk, vec2 from, vec2 to, Shape b, vec4 margin, bool sides) {
    Group group = group_of(b, walk.level, walk.group);
    uint boxes = 0u;
    for (uint i = 0u; i < group.count; ++i) {
        vec4 box = floats_at(group.first + i);
        vec2 t = vec2(0.0, 1.0);
        bool visit = clip_to_box(from, to - from, box + margin, t) ||
                     (sides && (ray_meets(from, box) || ray_meets(to, box)));
        boxes |= visit ? 1u << i : 0u;
    }
    add_boxes(walk, boxes);
}

void consider_chunk(vec2 from, vec2 to, Shape b, uint chunk, vec4 margin, bool sides,
                    inout Stretch stretch) {
    uint end = edges_end(b, chunk);
    for (uint slot = chunk_size * chunk; slot < end; ++slot) {
        vec4 edge = floats_at(b.edges + slot);
        vec4 edge_box = vec4(min(edge.xy, edge.zw), max(edge.xy, edge.zw));
        vec2 t = vec2(0.0, 1.0);
        if (clip_to_box(from, to - from, edge_box + margin, t)) {
            stretch.near = vec2(min(stretch.near.x, t.x), max(stretch.near.y, t.y));
        }
        if (sides) {
            stretch.first_inside = stretch.first_inside != crosses(from, edge.xy, edge.zw);
            stretch.last_inside = stretch.last_inside != crosses(to, edge.xy, edge.zw);
        }
    }
}

// False where the walk takes too long.
bool find_stretch(vec2 from, vec2 to, Shape b, float grow, bool sides, out Stretch stretch) {
    stretch = Stretch(vec2(infinity, -infinity), false, false);
    vec4 margin = vec4(-grow, -grow, grow, grow);
    Walk walk = start_walk(b);
    bool enters = true;
    for (uint i = 0u; i < max_steps; ++i) {
        if (enters) {
            enter(walk, from, to, b, margin, sides);
        }
        uint box;
        if (!next_box(walk, box)) {
            return true;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
        } else {
            consider_chunk(from, to, b, box, margin, sides, stretch);
        }
    }
    return false;
}

// The points of an edge that the next step looks at: `first`, ..., `first + count - 1`. It asks for
// the side of those from `ask_begin` to `ask_end - 1`; the others are known to be inside.
struct Points {
    uint first;
    uint count;
    uint ask_begin;
    uint ask_end;
};

Points points_of(Item item) {
    SearchDirectionData direction = direction_at(item.direction);
    Shape a = shape_at(direction.shape_a);
    Shape b = shape_at(direction.shape_b);
    vec4 edge = floats_at(a.edges + item.slot);
    uint parts = parts_of(direction, number_of(a, item.slot));
    vec2 from = placed(direction, edge.xy);
    vec2 end = placed(direction, edge.zw);
    vec2 to = parts == 1u ? from : from + (end - from) * (float(parts - 1u) / float(parts));
    bool sides = direction.outside == 0.0;
    Stretch stretch;
    if (!find_stretch(from, to, b, direction.reach + 2.0 * direction.margin, sides, stretch)) {
        return Points(0u, parts, 0u, parts);
    }
    if (stretch.near.y < stretch.near.x) {
        return Points(0u, stretch.first_inside ? parts : 0u, 0u, 0u);
    }
    // More points at either end, for rounding.
    float steps = float(parts - 1u);
    float slack = 1.0 + steps / 1048576.0;
    uint ask_begin = uint(max(floor(stretch.near.x * steps - slack), 0.0));
    uint ask_end = min(parts, uint(ceil(stretch.near.y * steps + slack)) + 1u);
    uint first = stretch.first_inside ? 0u : ask_begin;
    uint last = stretch.last_inside ? parts : ask_end;
    return Points(first, last - first, ask_begin, ask_end);
}

void main() {
    uint index = dispatched_index();
    bool exists = index < scratch[edge_total];
    Item item;
    Points points = Points(0u, 0u, 0u, 0u);
    if (exists) {
        item = item_of(index);
        points = points_of(item);
    }
    uint before = sum_before(points.count, push.edge_blocks + index / search_block);
    if (exists) {
        uint unit = push.edge_units + 2u * index;
        scratch_units[unit] = uvec4(item.direction, item.slot, points.first, before);
        scratch_units[unit + 1u] = uvec4(points.ask_begin, points.ask_end, points.count, 0u);
    }
}
