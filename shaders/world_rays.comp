#version 450
#extension GL_GOOGLE_include_directive : require

// The first hit of each segment, one thread per segment: the edges among which it is.

#include "world_queries.glsl"
#include "crossings.glsl"

layout(local_size_x = group_size) in;

const float smallest_step = 1e-30;  // in place of a coordinate that does not change

// A segment, in the world or in the frame of an instance.
struct Path {
    vec2 from;
    vec2 along;
    vec2 inverse;  // of `along`
    float margin;  // bound on the errors of positions
};

Path path_between(vec2 from, vec2 to, float margin) {
    vec2 along = to - from;
    vec2 steps = mix(along, vec2(smallest_step), lessThan(abs(along), vec2(smallest_step)));
    return Path(from, along, 1.0 / steps, margin);
}

// What may be the first hit: the edge, and the parameter before which it is not hit.
struct Candidates {
    vec4 parameters;
    uvec4 instances;
    uvec4 edges;
    float lost;   // the least parameter of those that found no room
    float bound;  // no later hit counts
};

void add_candidate(inout Candidates candidates, float parameter, uint instance, uint edge) {
    vec4 all = candidates.parameters;
    uint last = all.x >= max(all.y, max(all.z, all.w)) ? 0u
                : all.y >= max(all.z, all.w)           ? 1u
                : all.z >= all.w                       ? 2u
                                                       : 3u;
    candidates.lost = min(candidates.lost, max(parameter, all[last]));
    if (parameter < all[last]) {
        candidates.parameters[last] = parameter;
        candidates.instances[last] = instance;
        candidates.edges[last] = edge;
    }
}

// The parameter at which a path enters a box, or infinity if it does not before the bound.
float entry(Path path, vec4 box, float bound) {
    vec2 low = (box.xy - 2.0 * path.margin - path.from) * path.inverse;
    vec2 high = (box.zw + 2.0 * path.margin - path.from) * path.inverse;
    vec2 first = min(low, high);
    vec2 last = max(low, high);
    float enters = max(max(first.x, first.y), 0.0);
    return enters <= min(min(last.x, last.y), bound) ? enters : infinity;
}

// Takes the box that is entered first from the marked ones. False if none is entered.
bool take_first(inout Search search, Path path, float bound, out uint box) {
    Group group = current_group(search);
    Choice choice = start_choice(search);
    for (uint i = 0u; i < chunk_size; ++i) {
        add_key(choice, i, entry(path, box_of_group(search, group, i), bound));
    }
    return take(search, choice, box);
}

void test_edge(Path path, vec4 edge, uint instance, uint number, inout Candidates candidates) {
    vec2 a = edge.xy - path.from;
    vec2 b = edge.zw - path.from;
    vec2 other = edge.zw - edge.xy;
    float size = sum_of(path.along);
    float other_size = sum_of(other);
    float margin = path.margin;
    vec2 ends = vec2(cross_product(path.along, a), cross_product(path.along, b));
    vec2 own_ends = vec2(cross_product(a, other), cross_product(a - path.along, other));
    if (are_on_one_side(ends, 2.0 * margin * size) ||
        are_on_one_side(own_ends, 2.0 * margin * other_size)) {
        return;
    }
    // Wherever it is hit is beside it.
    float squared = dot(path.along, path.along);
    vec2 beside = vec2(dot(path.along, a), dot(path.along, b));
    float least = min(beside.x, beside.y) - 2.0 * margin * size;
    float largest = max(beside.x, beside.y) + 2.0 * margin * size;
    float parameter = squared > 0.0 ? max(least, 0.0) / squared : 0.0;
    if (largest < 0.0 || parameter > candidates.bound) {
        return;
    }
    if (are_on_two_sides(ends, 3.0 * margin * size) &&
        are_on_two_sides(own_ends, 3.0 * margin * other_size)) {
        // They cross. Where either is moved by its errors, both meet within two margins of there.
        float across = own_ends.x - own_ends.y;
        float crossing = own_ends.x / across;
        float doubt = 3.0 * margin * other_size / abs(across) + margin_of_frames;
        parameter = max(parameter, crossing - doubt);
        if (parameter > candidates.bound) {
            return;
        }
        candidates.bound = min(candidates.bound, crossing + doubt);
    }
    add_candidate(candidates, parameter, instance, number);
}

void test_chunk(Search search, Path path, uint chunk, inout Candidates candidates) {
    uint end = edges_end(search.shape, chunk);
    uint first = chunk_size * chunk;
    uint number = number_of(search.shape, first);
    for (uint slot = first; slot < end; ++slot) {
        test_edge(path, floats_at(search.shape.edges + slot), search.number, number + slot - first,
                  candidates);
    }
}

// False if single precision cannot tell, or the walk is too long.
bool find_first(RayData ray, inout Candidates candidates) {
    float places = sum_of(ray.from) + sum_of(ray.to) + push.magnitude;
    Path in_world = path_between(ray.from, ray.to,
                                 margin_of_frames * (sum_of(ray.from) + sum_of(ray.to)) +
                                     margin_of_places * push.magnitude);
    Path path = in_world;
    Search search = start_search();
    for (uint steps = 0u; steps < max_query_steps; ++steps) {
        uint box;
        if (!take_first(search, path, candidates.bound, box)) {
            if (!go_up(search)) {
                return !(candidates.lost <= candidates.bound);
            }
            if (!search.is_inside) {
                path = in_world;
            }
        } else if (search.walk.level > 0u) {
            go_down(search, box);
        } else if (search.is_inside) {
            test_chunk(search, path, box, candidates);
        } else if (find_instance(search, box)) {
            go_in(search, search.instance.shape);
            vec2 from = in_frame(search.instance, ray.from, ray.from_low);
            vec2 to = in_frame(search.instance, ray.to, ray.to_low);
            float margin = margin_in_frame(search.instance, sum_of(from) + sum_of(to), places);
            if (search.instance.left_to_cpu != 0u || !(margin <= max_query_margin)) {
                return false;
            }
            path = path_between(from, to, margin);
        }
    }
    return false;
}

RayData ray_at(uint index) {
    vec4 high = uintBitsToFloat(queries[units_of_ray * index]);
    vec4 low = uintBitsToFloat(queries[units_of_ray * index + 1u]);
    return RayData(high.xy, high.zw, low.xy, low.zw);
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.count) {
        return;
    }
    Candidates candidates = Candidates(vec4(infinity), uvec4(no_instance), uvec4(0u), infinity, 1.0);
    bool is_certain = find_first(ray_at(index), candidates);
    uvec4 instances =
        mix(candidates.instances, uvec4(no_instance),
            greaterThan(candidates.parameters, vec4(candidates.bound)));
    instances.x = is_certain ? instances.x : answered_by_cpu;
    uint unit = push.answers + units_of_ray_answer * index;
    scratch_units[unit] = instances;
    scratch_units[unit + 1u] = candidates.edges;
}
