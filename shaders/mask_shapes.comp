#version 450
#extension GL_GOOGLE_include_directive : require

// Shapes in the masks of tiles, one thread for a few edges that are consecutive in a shape: a part of a
// chunk, a chunk, or the chunks of a box. Of a volume, in each row of cell centres that an edge spans
// (lower end included, upper end excluded) the cells to its left are inverted. Only the last of them is
// marked here; who reads the row inverts those before it. The edges of a chunk right of the tile have the
// same effect as one edge between the chunk's ends. Of a boundary, the cells whose centres are within
// reach are set.

#include "push.h"
#include "shapes_in_tiles.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

layout(push_constant) uniform Push { MaskShapesPush push; };

// The shape that a thread belongs to.
MaskShapeData shape_of(uint index) {
    uint unit = push.shapes + units_of_mask_shape *
                                  last_of_input(index, 4u * (push.shapes + units_of_shape_in_tile),
                                                push.shape_count, 4u * units_of_mask_shape);
    uvec4 own = unit_at(unit + units_of_shape_in_tile);
    return MaskShapeData(shape_in_tile_at(unit), own.x, uintBitsToFloat(own.y), own.z, own.w);
}

// The cells of a row or column of `size` cells whose centres lie between two places relative to the
// tile's centre: the first, and the one after the last.
uvec2 cells_between(float low, float high, float size) {
    return uvec2(clamp(ceil(vec2(low, high) + (0.5 * size - 0.5)), 0.0, size));
}

uint word_of(MaskShapeData shape, uint row, uint column) {
    uint words_per_row = (unpacked(shape.placed.size).x + 31u) / 32u;
    return shape.placed.mask + row * words_per_row + column / 32u;
}

// Marks the last cell left of an edge in each row.
void mark(MaskShapeData shape, Exact a, Exact b, SeenEdge edge) {
    vec2 size = vec2(unpacked(shape.placed.size));
    uvec2 rows = cells_between(min(a.y.x, b.y.x), max(a.y.x, b.y.x), size.y);
    float slope = edge.way.x / edge.way.y;
    for (uint row = rows.x; row < rows.y; ++row) {
        float y = float(row) + 0.5 - 0.5 * size.y;
        float x = clamp(edge.nearest.x + (y - edge.nearest.y) * slope, min(a.x.x, b.x.x),
                        max(a.x.x, b.x.x));
        uint count = cells_between(x, x, size.x).x;
        if (count > 0u) {
            atomicXor(scratch[word_of(shape, row, count - 1u)], 1u << ((count - 1u) & 31u));
        }
    }
}

// What is within reach of a segment of an edge.
struct Capsule {
    vec2 a;
    vec2 b;
    vec2 side;  // from the segment to its left side
    float reach;
};

// The part of a row within a capsule: its ends lie on the half circles or on the sides. If there is none,
// the second is below the first.
vec2 part_of_row(Capsule capsule, float y) {
    vec2 up = vec2(y) - vec2(capsule.a.y, capsule.b.y);
    vec2 across = sqrt(max(vec2(capsule.reach * capsule.reach) - up * up, 0.0));
    vec2 middle = vec2(capsule.a.x, capsule.b.x);
    vec2 lows = mix(vec2(infinity), middle - across, lessThanEqual(abs(up), vec2(capsule.reach)));
    vec2 highs = mix(vec2(-infinity), middle + across, lessThanEqual(abs(up), vec2(capsule.reach)));
    vec2 way = capsule.b - capsule.a;
    vec2 along = (vec2(up.x) + vec2(-capsule.side.y, capsule.side.y)) / way.y;
    vec2 crossing = vec2(capsule.a.x) + vec2(capsule.side.x, -capsule.side.x) + along * way.x;
    bvec2 crosses = bvec2(way.y != 0.0 && along.x >= 0.0 && along.x <= 1.0,
                          way.y != 0.0 && along.y >= 0.0 && along.y <= 1.0);
    lows = min(lows, mix(vec2(infinity), crossing, crosses));
    highs = max(highs, mix(vec2(-infinity), crossing, crosses));
    return vec2(min(lows.x, lows.y), max(highs.x, highs.y));
}

void set_cells(MaskShapeData shape, uint row, uvec2 columns, uint edge) {
    uint cells = push.edges + shape.first_edge + row * unpacked(shape.placed.size).x;
    for (uint column = columns.x; column < columns.y;) {
        uint end = min(columns.y, (column | 31u) + 1u);
        uint count = end - column;
        uint bits = (count == 32u ? ~0u : (1u << count) - 1u) << (column & 31u);
        atomicOr(scratch[word_of(shape, row, column)], bits);
        uint listed = shape.first_edge == no_edges ? end : column;
        for (; listed < end; ++listed) {
            atomicMin(scratch[cells + listed], edge);
        }
        column = end;
    }
}

// Sets the cells within reach of an edge. Of a long one only what is near the tile counts, all of whose
// places are exact to a small part of a cell.
void set_near(MaskShapeData shape, SeenEdge edge, uint number) {
    vec2 size = vec2(unpacked(shape.placed.size));
    float reach = shape.reach;
    float farthest = 0.5 * length(size) + reach + 1.0;
    if (dot(edge.nearest, edge.nearest) > farthest * farthest) {
        return;
    }
    Capsule capsule = Capsule(edge.nearest + max(edge.from, -farthest) * edge.way,
                              edge.nearest + min(edge.to, farthest) * edge.way,
                              reach * vec2(-edge.way.y, edge.way.x), reach);
    uvec2 rows = cells_between(min(capsule.a.y, capsule.b.y) - reach,
                               max(capsule.a.y, capsule.b.y) + reach, size.y);
    for (uint row = rows.x; row < rows.y; ++row) {
        vec2 part = part_of_row(capsule, float(row) + 0.5 - 0.5 * size.y);
        if (part.x <= part.y) {
            set_cells(shape, row, cells_between(part.x, part.y, size.x), number);
        }
    }
}

// Where a box of a shape lies beside a tile.
struct Place {
    bool is_near;   // it reaches the tile, or of a volume the rows to the right of the tile
    bool is_right;  // of the tile
};

Place place_of(MaskShapeData own, vec4 box) {
    ShapeInTileData seen = own.placed;
    vec2 middle = 0.5 * (box.xy + box.zw);
    vec2 half_box = 0.5 * (box.zw - box.xy);
    vec2 half_size = 0.5 * vec2(unpacked(seen.size));
    // Relative to the tile's centre; the slack covers the errors of single precision.
    vec2 centre = vec2(seen.axis.x * middle.x - seen.axis.y * middle.y,
                       seen.axis.y * middle.x + seen.axis.x * middle.y) + seen.offset - half_size;
    vec2 beyond = half_size + vec2(dot(abs(seen.axis), half_box), dot(abs(seen.axis.yx), half_box)) +
                  seen.slack + max(own.reach, 0.0);
    bool is_right = centre.x > beyond.x;
    return Place(abs(centre.y) <= beyond.y && centre.x >= -beyond.x && !(is_right && own.reach >= 0.0),
                 is_right);
}

// The boxes of a walk's group that are near, a bit each.
uint near_boxes(MaskShapeData own, Shape shape, Walk walk) {
    Group group = group_of(shape, walk.level, walk.group);
    uint boxes = 0u;
    for (uint i = 0u; i < group.count; ++i) {
        boxes |= place_of(own, floats_at(group.first + i)).is_near ? 1u << i : 0u;
    }
    return boxes;
}

// Puts edges of one chunk into the mask.
void add_edges(MaskShapeData own, Shape shape, uint slot, uint end) {
    ShapeInTileData seen = own.placed;
    uint chunk = slot / chunk_size;
    end = min(end, edges_end(shape, chunk));
    bool is_right = place_of(own, floats_at(word_at(shape.first_boxes) + chunk)).is_right;
    uint step = is_right ? end - slot : 1u;
    vec2 centre = 0.5 * vec2(unpacked(seen.size));
    Exact a = placed(seen, floats_at(shape.edges + slot).xy, low_parts(seen, slot).xy, centre);
    for (; slot < end; slot += step) {
        uint last = slot + step - 1u;
        Exact b = placed(seen, floats_at(shape.edges + last).zw, low_parts(seen, last).zw, centre);
        SeenEdge edge = seen_edge(a, b);
        if (own.reach < 0.0) {
            mark(own, a, b, edge);
        } else {
            set_near(own, edge, number_of(shape, slot));
        }
        a = b;
    }
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    MaskShapeData own = shape_of(index);
    Shape shape = shape_at(own.placed.shape);
    uint first = (index - own.first_thread) << own.shift;
    uint count = min(1u << own.shift, chunk_size);
    // From the box of the thread's edges down to chunks.
    uint level = max(own.shift, box_shift) / box_shift - 1u;
    uint box = first >> (box_shift * (level + 1u));
    if (!place_of(own, floats_at(word_at(shape.first_boxes + level) + box)).is_near) {
        return;
    }
    Walk walk = Walk(level, box / chunk_size, uvec2(0u));
    add_boxes(walk, 1u << (box % chunk_size));
    while (true) {
        uint chunks = take_chunks(walk);
        while (chunks != 0u) {
            uint slot = max(chunk_size * (chunk_size * walk.group + take_bit(chunks)), first);
            add_edges(own, shape, slot, slot + count);
        }
        if (!next_box(walk, box)) {
            return;
        }
        descend(walk, box);
        add_boxes(walk, near_boxes(own, shape, walk));
    }
}
