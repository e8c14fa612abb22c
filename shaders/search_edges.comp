#version 450
#extension GL_GOOGLE_include_directive : require

// The search's third step, one thread per edge of A that can have points that are asked for. One
// walk over B's boxes finds the sides of the edge's first and last point, and the interval of the
// points that B's boundary may separate from them, or that lie within reach of it.

#include "search.glsl"
#include "direction_places.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"
#include "totals.glsl"
#include "scan.glsl"

// The points from + t * d, 0 <= t <= 1.
struct Line {
    vec2 from;
    vec2 to;
    vec2 d;
    vec2 inverse;  // of d; large where d is 0, so that t is either any number or none
    vec2 along;    // d / |d|^2: the dot product with it is t; 0 for a point
    float size;    // not below |d|
};

Line line_between(vec2 from, vec2 to) {
    const float smallest = 1e-30;
    const float shortest_squared = 1e-24;
    vec2 d = to - from;
    bvec2 is_long = greaterThan(abs(d), vec2(smallest));
    float squared = dot(d, d);
    vec2 along = squared > shortest_squared ? d / squared : vec2(0.0);
    return Line(from, to, d, mix(vec2(1.0 / smallest), 1.0 / d, is_long), along,
                abs(d.x) + abs(d.y));
}

// The interval of t in which the line is in a box; empty: y < x.
vec2 interval_in(Line line, vec4 box) {
    vec4 t = (box - line.from.xyxy) * line.inverse.xyxy;
    vec2 first = min(t.xy, t.zw);
    vec2 last = max(t.xy, t.zw);
    return vec2(max(max(first.x, first.y), 0.0), min(min(last.x, last.y), 1.0));
}

// The interval of t of the points that may be within `grow` of an edge; empty: y < x. These are near
// the part of the edge that is within `grow` of the straight line.
vec2 interval_near(Line line, vec4 edge, float grow) {
    vec2 first = edge.xy - line.from;
    vec2 last = edge.zw - line.from;
    vec2 sides = vec2(line.d.x * first.y - line.d.y * first.x, line.d.x * last.y - line.d.y * last.x);
    float limit = grow * line.size;
    float slope = sides.y - sides.x;
    vec2 u = slope != 0.0 ? clamp((vec2(-limit, limit) - sides.x) / slope, 0.0, 1.0)
                          : vec2(0.0, 1.0);
    vec2 t = mix(vec2(dot(first, line.along)), vec2(dot(last, line.along)), u);
    float more = grow * (abs(line.along.x) + abs(line.along.y));
    bool is_apart = min(sides.x, sides.y) > limit || max(sides.x, sides.y) < -limit;
    return is_apart ? vec2(1.0, 0.0)
                    : vec2(max(min(t.x, t.y) - more, 0.0), min(max(t.x, t.y) + more, 1.0));
}

// Whether the ray to growing x from either end meets a box.
bool rays_meet(Line line, vec4 box) {
    bvec2 above = greaterThanEqual(vec2(line.from.y, line.to.y), box.yy);
    bvec2 below = lessThanEqual(vec2(line.from.y, line.to.y), box.ww);
    bvec2 before = lessThanEqual(vec2(line.from.x, line.to.x), box.zz);
    return any(bvec2(uvec2(above) & uvec2(below) & uvec2(before)));
}

// Whether these rays meet an edge: bits of the first and the last.
uvec2 cross_edge(Line line, vec4 edge) {
    // Half-open in y, so a vertex on the ray counts once.
    vec2 y = vec2(line.from.y, line.to.y);
    float slope = (edge.z - edge.x) / (edge.w - edge.y);
    vec2 x = edge.x + (y - edge.y) * slope;
    uvec2 spans = uvec2(greaterThan(edge.yy, y)) ^ uvec2(greaterThan(edge.ww, y));
    return spans & uvec2(lessThan(vec2(line.from.x, line.to.x), x));
}

struct Stretch {
    vec2 near;  // the interval of the points that may be near B's boundary; empty: y < x
    uvec2 inside;  // 1: the first and the last point
};

// The boxes of a walk's group that the stretch, or the ray from either end, may meet.
void enter(inout Walk walk, Line line, Shape b, vec4 margin, bool sides) {
    Group group = group_of(b, walk.level, walk.group);
    uint boxes = 0u;
    vec4 next = floats_at(group.first);
    for (uint i = 0u; i < group.count; ++i) {
        vec4 box = next;
        next = floats_at(group.first + i + 1u);
        vec2 t = interval_in(line, box + margin);
        boxes |= t.x <= t.y || (sides && rays_meet(line, box)) ? 1u << i : 0u;
    }
    add_boxes(walk, boxes);
}

void consider_chunk(Line line, Shape b, uint chunk, vec4 margin, inout Stretch stretch) {
    uint end = edges_end(b, chunk);
    uint slot = chunk_size * chunk;
    vec4 next = floats_at(b.edges + slot);
    for (; slot < end; ++slot) {
        vec4 edge = next;
        next = floats_at(b.edges + slot + 1u);
        vec4 edge_box = vec4(min(edge.xy, edge.zw), max(edge.xy, edge.zw));
        vec2 t = interval_in(line, edge_box + margin);
        if (line.along != vec2(0.0)) {
            vec2 near = interval_near(line, edge, margin.z);
            t = vec2(max(t.x, near.x), min(t.y, near.y));
        }
        if (t.x <= t.y) {
            stretch.near = vec2(min(stretch.near.x, t.x), max(stretch.near.y, t.y));
        }
        stretch.inside ^= cross_edge(line, edge);
    }
}

// False where the walk takes too long. `sides`: those of the ends are asked for.
bool find_stretch(Line line, Shape b, float grow, bool sides, out Stretch stretch) {
    stretch = Stretch(vec2(infinity, -infinity), uvec2(0u));
    vec4 margin = vec4(-grow, -grow, grow, grow);
    Walk walk = start_walk(b);
    for (uint steps = 0u; steps < max_steps; ++steps) {
        enter(walk, line, b, margin, sides);
        uint chunks = take_chunks(walk);
        steps += bitCount(chunks);
        while (chunks != 0u) {
            uint chunk = chunk_size * walk.group + take_bit(chunks);
            consider_chunk(line, b, chunk, margin, stretch);
        }
        uint box;
        if (!next_box(walk, box)) {
            stretch.inside = sides ? stretch.inside : uvec2(0u);
            return true;
        }
        descend(walk, box);
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

Points points_of(uint direction_index, uint slot) {
    SearchDirectionData direction = direction_at(direction_index);
    Shape a = shape_at(direction.shape_a);
    Shape b = shape_at(direction.shape_b);
    vec4 edge = floats_at(a.edges + slot);
    uint parts = parts_of(direction, number_of(a, slot));
    if (parts == 0u) {
        return Points(0u, 0u, 0u, 0u);
    }
    vec2 from = placed(direction, edge.xy);
    vec2 end = placed(direction, edge.zw);
    vec2 to = parts == 1u ? from : from + (end - from) * (float(parts - 1u) / float(parts));
    bool sides = direction.outside == 0.0;
    Stretch stretch;
    float grow = direction.reach + 2.0 * direction.margin;
    if (!find_stretch(line_between(from, to), b, grow, sides, stretch)) {
        return Points(0u, parts, 0u, parts);
    }
    if (stretch.near.y < stretch.near.x) {
        return Points(0u, stretch.inside.x != 0u ? parts : 0u, 0u, 0u);
    }
    // More points at either end, for rounding.
    float steps = float(parts - 1u);
    float slack = 1.0 + steps / 1048576.0;
    uint ask_begin = uint(max(floor(stretch.near.x * steps - slack), 0.0));
    uint ask_end = min(parts, uint(ceil(stretch.near.y * steps + slack)) + 1u);
    uint first = stretch.inside.x != 0u ? 0u : ask_begin;
    uint last = stretch.inside.y != 0u ? parts : ask_end;
    return Points(first, last - first, ask_begin, ask_end);
}

void main() {
    uint index = dispatched_index();
    bool exists = index < scratch[edge_total];
    uint unit = push.edge_units + units_of_edge * index;
    uvec2 edge = exists ? scratch_unit(unit).xy : uvec2(0u);  // direction and slot
    Points points = Points(0u, 0u, 0u, 0u);
    if (exists) {
        points = points_of(edge.x, edge.y);
    }
    bool begins = !exists || gl_LocalInvocationID.x == 0u ||
                  scratch_unit(unit - units_of_edge).x != edge.x;
    uint place = place_before(begins, points.count, push.block_sums + index / search_block);
    if (exists) {
        scratch_units[unit] = uvec4(edge, points.first, place);
        scratch_units[unit + 1u] = uvec4(points.ask_begin, points.ask_end, points.count, 0u);
    }
    scan(push.edge_blocks, scratch[edge_total]);
}
