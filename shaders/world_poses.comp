#version 450
#extension GL_GOOGLE_include_directive : require

// Whether a shape at each of many poses meets an instance, one thread per pose. The shape is A, and
// the instance that it is compared with B.

#include "world_queries.glsl"
#include "frames.glsl"
#include "crossings.glsl"
#include "rings_inside.glsl"

layout(local_size_x = group_size) in;

// What a walk looks for: instances; of one, chunks of A near B; chunks of B near a chunk of A; or
// rings of one shape in the other.
const uint finds_instances = 0u;
const uint finds_own_chunks = 1u;
const uint finds_chunks = 2u;
const uint finds_rings = 3u;

// The shape at the pose, and the instance that it is compared with.
struct Test {
    SearchDirectionData direction;
    Limits limits;
    uint verdict;
    uint chunk;  // of A
    vec4 box;    // of that chunk, or else of B, in B's frame, grown by what is near
    Shape other;
    Walk walk;  // over B's boxes
    RingSearch rings;
};

// The shape at a pose.
SearchInstanceData posed(uint index) {
    vec4 first = uintBitsToFloat(queries[units_of_pose * index]);
    uvec4 second = queries[units_of_pose * index + 1u];
    SearchInstanceData posed;
    posed.axis = first.xy;
    posed.high = first.zw;
    posed.low = uintBitsToFloat(second.xy);
    posed.unit = push.unit;
    posed.radius = push.radius;
    posed.shape = push.shape;
    posed.rounding = uintBitsToFloat(second.z);
    return posed;
}

vec4 box_in_world(SearchInstanceData posed) {
    mat2 frame = posed.unit * mat2(posed.axis.x, posed.axis.y, -posed.axis.y, posed.axis.x);
    return turned_box(box_of_shape(posed.shape), frame, posed.high,
                      margin_of_frames * (posed.radius + sum_of(posed.high)) +
                          2.0 * posed.rounding);
}

// False if single precision cannot tell.
bool start_test(SearchInstanceData posed, SearchInstanceData instance, out Test test) {
    test.direction = frames_of(posed, instance);
    float margin = test.direction.margin;
    test.limits = Limits(-3.0 * margin, 3.0 * margin, 3.0 * margin);
    test.verdict = 0u;
    test.other = shape_at(instance.shape);
    vec4 whole = box_of_shape(instance.shape);
    test.box = whole + test.limits.far * vec4(-2.0, -2.0, 2.0, 2.0);
    test.rings.ring = 0u;
    test.rings.follows = false;
    return instance.left_to_cpu == 0u && margin <= max_query_margin;
}

// Takes one of the marked boxes that overlap: of instances with the box of the pose, or of A's with
// that of B. False if none does.
bool take_overlapping(inout Search search, vec4 own, Test test, out uint box) {
    Group group = current_group(search);
    mat2 frame = rotation_of(test.direction);
    Choice choice = start_choice(search);
    for (uint i = 0u; i < chunk_size; ++i) {
        vec4 other = box_of_group(search, group, i);
        bool overlaps = search.is_inside
                            ? do_overlap(turned_box(other, frame, test.direction.offset, 0.0), test.box)
                            : do_overlap(other, own);
        add_key(choice, i, overlaps ? 0.0 : infinity);
    }
    return take(search, choice, box);
}

// Goes on with the chunks of B that are near a chunk of A.
void start_chunk(Search search, uint chunk, inout Test test) {
    Group chunks = Group(word_at(search.shape.first_boxes), 0u);
    test.chunk = chunk;
    test.box = turned_box(floats_at(chunks.first + chunk), rotation_of(test.direction),
                          test.direction.offset, 2.0 * test.limits.far);
    test.walk = start_walk(test.other);
    Group group = group_of(test.other, test.walk.level, 0u);
    add_boxes(test.walk, (1u << group.count) - 1u);
}

// All edges of A's chunk with all of B's.
void test_chunk(Search search, uint chunk, inout Test test) {
    uint own_end = edges_end(search.shape, test.chunk);
    uint end = edges_end(test.other, chunk);
    for (uint own = chunk_size * test.chunk; own < own_end; ++own) {
        vec4 edge = floats_at(search.shape.edges + own);
        vec2 from = placed(test.direction, edge.xy);
        vec2 to = placed(test.direction, edge.zw);
        for (uint slot = chunk_size * chunk; slot < end; ++slot) {
            test.verdict |= verdict_on(from, to, floats_at(test.other.edges + slot), test.limits);
        }
    }
}

// One step of the walk over B's boxes; false at its end.
bool step_in_other(Search search, inout Test test) {
    uint box;
    if (!next_box(test.walk, box)) {
        return false;
    }
    if (!do_overlap(floats_at(group_of(test.other, test.walk.level, 0u).first + box), test.box)) {
        return true;
    }
    if (test.walk.level == 0u) {
        test_chunk(search, box, test);
        return true;
    }
    descend(test.walk, box);
    uint count = group_of(test.other, test.walk.level, test.walk.group).count;
    add_boxes(test.walk, (1u << count) - 1u);
    return true;
}

uint answer_for(SearchInstanceData posed) {
    vec4 own = box_in_world(posed);
    bool in_doubt = false;
    uint goal = finds_instances;
    Test test;
    test.direction = SearchDirectionData(vec2(1.0, 0.0), vec2(0.0), 0u, 0u, 0u, 0u, 0.0, 0.0, 0.0, 0.0,
                                         0.0, 0.0, 0u, 0u);
    test.verdict = 0u;
    Search search = start_search();
    for (uint steps = 0u; steps < max_pose_steps; ++steps) {
        uint box;
        if (goal == finds_chunks) {
            if (!step_in_other(search, test)) {
                test.box = box_of_shape(test.direction.shape_b) +
                           test.limits.far * vec4(-2.0, -2.0, 2.0, 2.0);
                goal = finds_own_chunks;
            }
        } else if (goal == finds_rings) {
            goal = step_in_rings(test.direction, test.rings, test.verdict) ? finds_rings
                                                                           : finds_instances;
        } else if (take_overlapping(search, own, test, box)) {
            if (search.walk.level > 0u) {
                go_down(search, box);
            } else if (search.is_inside) {
                start_chunk(search, box, test);
                goal = finds_chunks;
            } else if (find_instance(search, box)) {
                if (!start_test(posed, search.instance, test)) {
                    return answered_by_cpu;
                }
                go_in(search, push.shape);
                goal = finds_own_chunks;
            }
        } else if (!go_up(search)) {
            return in_doubt ? answered_by_cpu : 0u;
        } else if (goal == finds_own_chunks && !search.is_inside) {
            in_doubt = in_doubt || test.verdict != 0u;
            goal = test.verdict == 0u ? finds_rings : finds_instances;
        }
        if ((test.verdict & pair_meets) != 0u) {
            return 1u;
        }
    }
    return answered_by_cpu;
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index < push.count) {
        scratch[4u * push.answers + index] = answer_for(posed(index));
    }
}
