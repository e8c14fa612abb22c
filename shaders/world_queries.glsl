// What a thread that asks about a world's instances has in common with others: the walk over the
// boxes of instances and, within one of them, over those of its shape.

#include "push.h"
#include "shapes.glsl"
#include "scratch.glsl"

layout(push_constant) uniform Push { WorldQueryPush push; };

#include "pairs.glsl"
#include "world_queries.h"

layout(std430, set = 0, binding = 3) readonly buffer Queries {
    uvec4 queries[];
};

// A walk over the boxes of the instances. In an instance it goes on over those of the shape, whose
// lowest level are chunks.
struct Search {
    Walk walk;
    Walk outside;  // while in an instance
    bool is_inside;
    SearchInstanceData instance;
    uint number;  // of the instance
    Shape shape;
};

// Marks all boxes of the group that the walk is at.
void mark_all(inout Search search, uint count) {
    add_boxes(search.walk, (1u << count) - 1u);
}

Group current_group(Search search) {
    uint level = search.walk.level;
    uint group = search.walk.group;
    if (search.is_inside) {
        return group_of(search.shape, level, group);
    }
    return Group(level_unit(level) + chunk_size * group,
                 min(level_size(level) - chunk_size * group, chunk_size));
}

// The marked boxes of the group, one bit each.
uint marked_boxes(Walk walk) {
    uint word = walk.level < 4u ? walk.pending.x : walk.pending.y;
    return word >> (chunk_size * (walk.level & 3u)) & ((1u << chunk_size) - 1u);
}

void unmark(inout Walk walk, uint boxes) {
    uint bits = boxes << (chunk_size * (walk.level & 3u));
    walk.pending &= ~(walk.level < 4u ? uvec2(bits, 0u) : uvec2(0u, bits));
}

// A box of the group; of those behind its end, the last one.
vec4 box_of_group(Search search, Group group, uint bit) {
    uint unit = group.first + min(bit, group.count - 1u);
    return search.is_inside ? floats_at(unit) : uintBitsToFloat(scratch_unit(unit));
}

// Which of the marked boxes of the group to go to, by keys that are given one by one.
struct Choice {
    uint boxes;  // marked, one bit each
    uint left;   // of these, those whose key is finite
    uint first;  // that with the least key
    float least;
};

Choice start_choice(Search search) {
    return Choice(marked_boxes(search.walk), 0u, 0u, infinity);
}

void add_key(inout Choice choice, uint bit, float key) {
    bool counts = (choice.boxes >> bit & 1u) != 0u && key < infinity;
    choice.left |= counts ? 1u << bit : 0u;
    choice.first = counts && key < choice.least ? bit : choice.first;
    choice.least = counts ? min(choice.least, key) : choice.least;
}

// Takes the box with the least key from the marked ones of the group; those whose key is not finite
// are marked no more. False if there is no other.
bool take(inout Search search, Choice choice, out uint box) {
    unmark(search.walk, choice.boxes);
    if (choice.left == 0u) {
        return false;
    }
    add_boxes(search.walk, choice.left & ~(1u << choice.first));
    box = chunk_size * search.walk.group + choice.first;
    return true;
}

uint top_level() {
    uint level = 0u;
    while (level_size(level) > chunk_size) {
        ++level;
    }
    return level;
}

Search start_search() {
    Search search;
    search.walk = Walk(top_level(), 0u, uvec2(0u));
    search.is_inside = false;
    mark_all(search, level_size(search.walk.level));
    return search;
}

// Goes to the lowest level that has marked boxes, or out of the instance; false at the end.
bool go_up(inout Search search) {
    Walk walk = search.walk;
    if ((walk.pending.x | walk.pending.y) == 0u) {
        bool was_inside = search.is_inside;
        search.walk = search.outside;
        search.is_inside = false;
        return was_inside;
    }
    bool upper = walk.pending.x == 0u;
    uint level = findLSB(upper ? walk.pending.y : walk.pending.x) / chunk_size + (upper ? 4u : 0u);
    search.walk.group >>= 3u * (level - walk.level);
    search.walk.level = level;
    return true;
}

void go_down(inout Search search, uint box) {
    descend(search.walk, box);
    mark_all(search, current_group(search).count);
}

// Looks up the instance at a place of the lowest level. False if the query does not consider it.
bool find_instance(inout Search search, uint place) {
    uvec4 name = scratch_unit(place_unit(place));  // number, category and mask
    if (name.x == push.ignored || (name.z & push.category) == 0u || (name.y & push.mask) == 0u) {
        return false;
    }
    search.number = name.x;
    search.instance = instance_at(name.x);
    return true;
}

// Goes on with the boxes of a shape.
void go_in(inout Search search, uint shape) {
    search.shape = shape_at(shape);
    search.outside = search.walk;
    search.walk = start_walk(search.shape);
    search.is_inside = true;
    mark_all(search, current_group(search).count);
}

// A position in the frame of the instance.
vec2 in_frame(SearchInstanceData instance, vec2 high, vec2 low) {
    vec2 apart = (high - instance.high) + (low - instance.low);
    return mat2(instance.axis.x, -instance.axis.y, instance.axis.y, instance.axis.x) * apart /
           instance.unit;
}

// Bound on the errors in the frame of the instance. `extent`: of positions there; `places`: the sum
// of the coordinates of what is asked about.
float margin_in_frame(SearchInstanceData instance, float extent, float places) {
    float rounding = margin_of_places * (places + sum_of(instance.high)) + 4.0 * instance.rounding;
    return margin_of_frames * (extent + 2.0 * instance.radius / instance.unit) +
           rounding / instance.unit;
}
