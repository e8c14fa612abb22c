#version 450
#extension GL_GOOGLE_include_directive : require

// The nearest instance of each point, one thread per point, and the edges among which its nearest
// one is. Distances are signed, negative inside, or those from edges.

#include "world_queries.glsl"
#include "crossings.glsl"

layout(local_size_x = group_size) in;

// Squares of coordinates in frames stay far below the largest float.
const float largest_extent = 1e12;

// What a walk looks for: instances; of one, how often a ray from the point meets its edges, which
// tells whether the point is inside; or the edges that are nearest.
const uint finds_instances = 0u;
const uint finds_side = 1u;
const uint finds_edges = 2u;

// The edges of an instance that are nearest, in its frame.
struct Near {
    vec2 point;
    float margin;  // bound on the errors of positions
    bool may_be_in;
    bool is_in;
    vec3 distances;
    uvec3 edges;
    float lost;  // the least distance of those that found no room
};

// The nearest instance.
struct Best {
    uvec4 answer;
    float least;    // its distance is between these
    float largest;
    bool is_certain;  // its side, and its edges
    float others;     // no other instance is as near as this
};

// The distance from a box as far as it is of interest, otherwise infinity.
float key(uint goal, vec2 p, vec4 box, float margin, float reach) {
    if (goal == finds_side) {
        return p.y >= box.y && p.y <= box.w && p.x <= box.z ? 0.0 : infinity;
    }
    float apart = length(way_to_box(p, box));
    return apart <= reach * (1.0 + margin_of_frames) + margin ? apart : infinity;
}

// Takes the box that is nearest from the marked ones. False if none is of interest.
bool take_nearest(uint goal, inout Search search, vec2 p, float margin, float reach,
                  out uint box) {
    Group group = current_group(search);
    Choice choice = start_choice(search);
    for (uint i = 0u; i < chunk_size; ++i) {
        add_key(choice, i, key(goal, p, box_of_group(search, group, i), margin, reach));
    }
    return take(search, choice, box);
}

// Whether a ray from `p` in the direction of x crosses an edge. Half-open in y, so that a vertex on
// it counts once. A point beside the box of the edge needs no product, which would be rounded.
bool crosses(vec2 p, vec4 edge) {
    vec2 along = edge.zw - edge.xy;
    bool is_level = (edge.y > p.y) != (edge.w > p.y);
    bool is_left = cross_product(along, p - edge.xy) > 0.0 == along.y > 0.0;
    return is_level && p.x <= max(edge.x, edge.z) && (p.x < min(edge.x, edge.z) || is_left);
}

void add_edge(inout Near near, float apart, uint edge) {
    vec3 all = near.distances;
    uint last = all.x >= max(all.y, all.z) ? 0u : all.y >= all.z ? 1u : 2u;
    near.lost = min(near.lost, max(apart, all[last]));
    if (apart < all[last]) {
        near.distances[last] = apart;
        near.edges[last] = edge;
    }
}

void look_at_chunk(uint goal, Search search, uint chunk, inout Near near) {
    uint first = chunk_size * chunk;
    uint end = edges_end(search.shape, chunk);
    uint number = number_of(search.shape, first);
    for (uint slot = first; slot < end; ++slot) {
        vec4 edge = floats_at(search.shape.edges + slot);
        if (goal == finds_side) {
            near.is_in = near.is_in != crosses(near.point, edge);
        } else {
            add_edge(near, distance(near.point, nearest_on_segment(near.point, edge.xy, edge.zw)),
                     number + slot - first);
        }
    }
}

float least_of(vec3 values) {
    return min(values.x, min(values.y, values.z));
}

// Bound on the error of a distance.
float doubt_of(Near near, float apart) {
    return 2.0 * near.margin + margin_of_frames * apart;
}

// No edge is the nearest that is farther away than this.
float nearby_of(Near near) {
    float apart = least_of(near.distances);
    return apart + 2.0 * doubt_of(near, apart);
}

// The largest distance of interest: that of the nearest instance, which a point that is inside is
// near too.
float reach_of(Best best) {
    return min(max(best.largest, 0.0), push.largest);
}

// How far edges are of interest, in the frame of the instance; all of them if the point is inside.
float reach_in_frame(Best best, Near near, SearchInstanceData instance) {
    float nearby = nearby_of(near) + near.margin;
    float reach = reach_of(best) / instance.unit + 3.0 * near.margin;
    return near.is_in ? nearby : min(nearby, reach);
}

// Once all edges of interest of an instance are known.
void offer(inout Best best, Near near, SearchInstanceData instance, uint number) {
    float apart = least_of(near.distances);
    if (apart == infinity) {
        return;
    }
    float doubt = doubt_of(near, apart);
    bool has_side = !near.may_be_in || apart > doubt;
    vec2 range = instance.unit * vec2(apart - doubt, apart + doubt);
    if (range.x * (1.0 - margin_of_frames) > push.largest) {
        return;
    }
    // Whether a point that is so deep inside counts decides about those that are less deep.
    bool counts = !near.is_in || range.y * (1.0 + margin_of_frames) < push.largest;
    float nearby = nearby_of(near);
    range = has_side ? (near.is_in ? -range.yx : range) : vec2(-range.y, range.y);
    if (range.y >= best.largest) {
        best.others = min(best.others, range.x);
        return;
    }
    uvec3 edges = mix(near.edges, uvec3(no_edge), greaterThan(near.distances, vec3(nearby)));
    best = Best(uvec4(number | (near.is_in ? point_in_instance : 0u), edges), range.x, range.y,
                has_side && counts && near.lost > nearby, min(best.others, best.least));
}

// False if single precision cannot tell, or the walk is too long.
bool find_nearest(NearestData point, inout Best best) {
    float places = sum_of(point.at) + push.magnitude;
    float margin_in_world = margin_of_frames * sum_of(point.at) + margin_of_places * places;
    uint goal = finds_instances;
    Near near;
    near.is_in = false;
    near.margin = 0.0;
    near.point = point.at;
    near.distances = vec3(infinity);
    Search search = start_search();
    for (uint steps = 0u; steps < max_query_steps; ++steps) {
        bool in_instance = goal != finds_instances;
        uint box;
        if (take_nearest(goal, search, in_instance ? near.point : point.at,
                         in_instance ? 0.0 : margin_in_world,
                         in_instance ? reach_in_frame(best, near, search.instance)
                                     : reach_of(best),
                         box)) {
            if (search.walk.level > 0u) {
                go_down(search, box);
            } else if (in_instance) {
                look_at_chunk(goal, search, box, near);
            } else if (find_instance(search, box)) {
                go_in(search, search.instance.shape);
                SearchInstanceData instance = search.instance;
                near.point = in_frame(instance, point.at, point.low);
                near.margin = margin_in_frame(instance, sum_of(near.point), places);
                near.is_in = false;
                near.distances = vec3(infinity);
                near.lost = infinity;
                vec4 whole = box_of_shape(instance.shape);
                near.may_be_in = push.is_signed != 0u &&
                                 length(way_to_box(near.point, whole)) <= 2.0 * near.margin;
                goal = near.may_be_in ? finds_side : finds_edges;
                if (instance.left_to_cpu != 0u || !(sum_of(near.point) <= largest_extent)) {
                    return false;
                }
            }
        } else if (goal == finds_side && all(equal(search.walk.pending, uvec2(0u)))) {
            search.walk = start_walk(search.shape);
            mark_all(search, current_group(search).count);
            goal = finds_edges;
        } else {
            if (!go_up(search)) {
                return best.answer.x == no_instance ||
                       (best.is_certain && best.others > best.largest);
            }
            if (in_instance && !search.is_inside) {
                offer(best, near, search.instance, search.number);
                goal = finds_instances;
            }
        }
    }
    return false;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.count) {
        return;
    }
    vec4 point = uintBitsToFloat(queries[units_of_nearest * index]);
    Best best = Best(uvec4(no_instance), infinity, infinity, true, infinity);
    bool is_certain = find_nearest(NearestData(point.xy, point.zw), best);
    best.answer.x = is_certain ? best.answer.x : answered_by_cpu;
    scratch_units[push.answers + units_of_nearest_answer * index] = best.answer;
}
