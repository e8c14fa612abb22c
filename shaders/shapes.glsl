// Shapes as the device's searches read them (search.h), and walks over their boxes. Positions and
// lengths are in the shape's frame, relative to its centre, in its units.

#include "search.h"
#include "segments.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Input {
    uvec4 units[];
};
layout(set = 0, binding = 8) uniform usamplerBuffer texels;  // the same memory
layout(constant_id = 0) const bool reads_texels = false;

const float infinity = 1.0 / 0.0;

// The parts of the input. Some devices read texels several times as fast, and others allow too few.
uvec4 unit_at(uint unit) {
    return reads_texels ? texelFetch(texels, int(unit)) : units[unit];
}

vec4 floats_at(uint unit) {
    return uintBitsToFloat(unit_at(unit));
}

uint word_at(uint word) {
    return unit_at(word >> 2)[word & 3u];
}

// The last of `count` words of the input, `stride` apart, that is at most `key`; they ascend.
uint last_of_input(uint key, uint first, uint count, uint stride) {
    uint last = 0u;
    while (count > 1u) {
        uint half_count = count / 2u;
        bool is_before = word_at(first + stride * (last + half_count)) <= key;
        last += is_before ? half_count : 0u;
        count = is_before ? count - half_count : half_count;
    }
    return last;
}

struct Shape {
    uint chunks;
    uint levels;
    uint edges;  // first unit
    uint infos;  // first word
    uint first_boxes;  // first word: of each level, its first unit
};

Shape shape_at(uint unit) {
    uvec4 head = unit_at(unit);
    return Shape(head.x, head.y, head.z, head.w, 4u * (unit + unit_of_first_boxes));
}

vec4 box_of_shape(uint unit) {
    return floats_at(unit + unit_of_box);
}

bool do_overlap(vec4 box, vec4 other) {
    return all(lessThanEqual(box.xy, other.zw)) && all(lessThanEqual(other.xy, box.zw));
}

// The box around a box in another frame, which lies at `offset` there.
vec4 turned_box(vec4 box, mat2 frame, vec2 offset, float grow) {
    vec2 centre = frame * (0.5 * (box.xy + box.zw)) + offset;
    vec2 half_size = 0.5 * (box.zw - box.xy);
    vec2 reach = abs(frame[0]) * half_size.x + abs(frame[1]) * half_size.y + grow;
    return vec4(centre - reach, centre + reach);
}

// The chunk at a place along the rings of the shape.
uint chunk_along_rings(Shape shape, uint place) {
    return word_at(shape.infos + 4u * ((shape.chunks + 3u) / 4u) + place);
}

// The end of the slots of a chunk's edges.
uint edges_end(Shape shape, uint chunk) {
    return chunk_size * chunk + (word_at(shape.infos + chunk) & 15u);
}

// The number of the edge in a slot.
uint number_of(Shape shape, uint slot) {
    return (word_at(shape.infos + slot / chunk_size) >> 4) + slot % chunk_size;
}

float squared_distance_to_box(vec2 p, vec4 box) {
    vec2 way = way_to_box(p, box);
    return dot(way, way);
}

// A walk over the boxes of a shape from the top level to chunks, depth first. Searches enter a group of
// boxes and then look at its chunks in one loop: some devices execute the body of a condition even if no
// thread needs it.
struct Walk {
    uint level;
    uint group;     // the boxes of this level that were entered last are 8 * group, ...
    uvec2 pending;  // boxes still to be visited: eight bits per level
};

// The boxes of a walk's group.
struct Group {
    uint first;  // unit
    uint count;
};

Group group_of(Shape shape, uint level, uint group) {
    uint boxes = (shape.chunks + (1u << (3u * level)) - 1u) >> (3u * level);
    return Group(word_at(shape.first_boxes + level) + chunk_size * group,
                 min(boxes - chunk_size * group, chunk_size));
}

// Follows the box nearest to a point from level to level.
uint nearest_chunk(Shape shape, vec2 p) {
    uint box = 0u;
    for (uint level = shape.levels; level > 0u; --level) {
        Group group = group_of(shape, level - 1u, box);
        uint best = 0u;
        float least_squared = infinity;
        for (uint i = 0u; i < group.count; ++i) {
            float d = squared_distance_to_box(p, floats_at(group.first + i));
            best = d < least_squared ? i : best;
            least_squared = min(d, least_squared);
        }
        box = chunk_size * box + best;
    }
    return box;
}

Walk start_walk(Shape shape) {
    return Walk(shape.levels - 1u, 0u, uvec2(0u));
}

// Marks boxes of the walk's group, one bit each, as ones to be visited.
void add_boxes(inout Walk walk, uint boxes) {
    uint bits = boxes << (chunk_size * (walk.level & 3u));
    walk.pending |= walk.level < 4u ? uvec2(bits, 0u) : uvec2(0u, bits);
}

// The marked chunks of the walk's group, one bit each, which then need no visit. The first one of the
// group has the number chunk_size * walk.group.
uint take_chunks(inout Walk walk) {
    uint chunks = walk.level == 0u ? walk.pending.x & ((1u << chunk_size) - 1u) : 0u;
    walk.pending.x ^= chunks;
    return chunks;
}

// Takes the lowest bit, and returns its number.
uint take_bit(inout uint bits) {
    uint bit = findLSB(bits);
    bits &= bits - 1u;
    return bit;
}

// Goes to the next box to visit, on the lowest level that has one, and says which it is; false at
// the end of the walk.
bool next_box(inout Walk walk, out uint box) {
    bool upper = walk.pending.x == 0u;
    uint word = upper ? walk.pending.y : walk.pending.x;
    if (word == 0u) {
        return false;
    }
    uint bit = findLSB(word);
    walk.pending &= upper ? uvec2(0u, word - 1u) : uvec2(word - 1u, ~0u);
    uint level = bit / chunk_size + (upper ? 4u : 0u);
    walk.group >>= 3u * (level - walk.level);
    walk.level = level;
    box = chunk_size * walk.group + bit % chunk_size;
    return true;
}

void descend(inout Walk walk, uint box) {
    walk.group = box;
    --walk.level;
}
