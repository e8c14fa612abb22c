// The search for boundary points: the structures of engine/plan/point_search.hpp (std430), and walks
// over a shape's boxes. Lengths are in world units; all positions are in B's frame, relative to its
// centre.

layout(std430, set = 0, binding = 0) readonly buffer Input {
    uvec4 units[];
};
layout(std430, set = 0, binding = 0) readonly buffer FloatInput {
    vec4 float_units[];  // the same memory
};
layout(std430, set = 0, binding = 0) readonly buffer WordInput {
    uint input_words[];  // the same memory
};
layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 1) buffer ScratchUnits {
    uvec4 scratch_units[];  // the same memory
};

layout(push_constant) uniform Push {
    uint first;           // item of this dispatch
    uint items;           // pieces of eight edges of A, of all directions
    uint directions;      // first unit
    uint direction_count;
    uint item_blocks;     // first words, and first units, of arrays in the scratch memory
    uint edge_blocks;
    uint point_blocks;
    uint item_words;
    uint edge_units;
    uint point_units;
    uint stage;           // of search_scan.comp
    uint capacity;        // of the elements that the stage counts
} push;

const uint block_size = 64u;  // elements with one sum; one workgroup
const uint chunk_size = 8u;   // edges per box, and boxes per box of the next level
const uint max_levels = 8u;
const uint no_parts = 0xffffffffu;
const float infinity = 1.0 / 0.0;

// The counts at the start of the scratch memory.
const uint edge_total = 0u;
const uint point_total = 1u;
const uint record_total = 2u;

uint dispatched_index() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * block_size +
           gl_LocalInvocationID.x;
}

struct Direction {
    mat2 rotation;  // from A's frame to B's
    vec2 translation;
    uint shape_a;  // first units
    uint shape_b;
    uint parts;  // first word: of each edge of A, its number of parts; no_parts: one each
    uint first_item;
    float reach;   // farther from B's boundary than this, points outside are not asked for
    float margin;  // bound on the errors of single precision
    float rival;   // a second point that is farther by no more makes the nearest not unique
    bool outside;  // points outside B are asked for as well
    float doubt;   // a second edge that is farther by no more leaves the nearest one in doubt;
                   // negative: none does
};

Direction direction_at(uint index) {
    uint unit = push.directions + 4u * index;
    vec4 place = float_units[unit];
    uvec4 shapes = units[unit + 1u];
    vec4 lengths = float_units[unit + 2u];
    return Direction(mat2(place.x, place.y, -place.y, place.x), place.zw, shapes.x, shapes.y,
                     shapes.z, shapes.w, lengths.x, lengths.y, lengths.z, lengths.w != 0.0,
                     float_units[unit + 3u].x);
}

// The direction that an item belongs to.
uint direction_of(uint item) {
    // The first directions of blocks of items follow the directions.
    uint blocks = 4u * (push.directions + 4u * push.direction_count);
    uint block = item / block_size;
    uint low = input_words[blocks + block];
    uint count = (block_size * (block + 1u) < push.items ? input_words[blocks + block + 1u] + 1u
                                                         : push.direction_count) - low;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (units[push.directions + 4u * (low + half_count) + 1u].w <= item) {
            low += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    return low;
}

struct Shape {
    uint chunks;
    uint levels;
    uint edges;  // first unit: one per edge, eight per chunk
    uint infos;  // first word: of each chunk, its first edge << 4 | its number of edges
    vec4 box;
    uint first_box[max_levels];  // first units, by level
};

Shape shape_at(uint unit) {
    uvec4 head = units[unit];
    uvec4 low = units[unit + 2u];
    uvec4 high = units[unit + 3u];
    return Shape(head.x, head.y, head.z, head.w, float_units[unit + 1u],
                 uint[](low.x, low.y, low.z, low.w, high.x, high.y, high.z, high.w));
}

uint parts_of(Direction direction, uint edge) {
    return direction.parts == no_parts ? 1u : input_words[direction.parts + edge];
}

// The last i of `count` with value(i) <= key, where value is a word of the scratch memory.
uint last_block(uint first, uint count, uint key) {
    uint low = 0u;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (scratch[first + low + half_count] <= key) {
            low += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    return low;
}

float distance_to_box(vec2 p, vec4 box) {
    return length(max(max(box.xy - p, p - box.zw), vec2(0.0)));
}

vec2 nearest_on_segment(vec2 p, vec2 a, vec2 b) {
    vec2 d = b - a;
    float squared = dot(d, d);
    return a + (squared > 0.0 ? clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0.0) * d;
}

bool crosses(vec2 p, vec2 a, vec2 b) {
    // Half-open in y, so a vertex on the ray counts once.
    return (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

bool ray_meets(vec2 p, vec4 box) {
    return p.y >= box.y && p.y <= box.w && p.x <= box.z;
}

// A walk over the boxes of a shape from the top level to chunks. At each step, `mask` holds the
// boxes of the present group that are still to be visited; those of the groups above wait.
struct Walk {
    uint level;
    uint group;  // its boxes are 8 * group, ...
    uint mask;
    uint groups[max_levels];
    uint masks[max_levels];
};

uint boxes_of_group(Shape shape, uint level, uint group) {
    uint count = (shape.chunks + (1u << (3u * level)) - 1u) >> (3u * level);
    return min(count - chunk_size * group, chunk_size);
}

Walk start_walk(Shape shape) {
    Walk walk;
    walk.level = shape.levels - 1u;
    walk.group = 0u;
    walk.mask = 0u;
    return walk;
}

void descend(inout Walk walk, uint box) {
    walk.groups[walk.level] = walk.group;
    walk.masks[walk.level] = walk.mask;
    walk.group = box;
    --walk.level;
}

// Returns the next box to visit in a group, after going up where a group has none left; false at
// the end of the walk.
bool next_box(Shape shape, inout Walk walk, out uint box) {
    while (walk.mask == 0u) {
        ++walk.level;
        if (walk.level >= shape.levels) {
            return false;
        }
        walk.group = walk.groups[walk.level];
        walk.mask = walk.masks[walk.level];
    }
    uint bit = findLSB(walk.mask);
    walk.mask &= walk.mask - 1u;
    box = chunk_size * walk.group + bit;
    return true;
}
