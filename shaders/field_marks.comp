#version 450
#extension GL_GOOGLE_include_directive : require

// The fill of field tiles, first part: one thread per chunk of B's edges and tile. In each row of cell
// centres that an edge spans (lower end included, upper end excluded) the cells to its left are
// inverted. Only the last of them is marked here; mask_rows.comp inverts those before it. The edges of
// a chunk right of the tile have the same effect as one edge between the chunk's ends.

#include "fields.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) buffer Scratch {
    uint scratch[];
};

void mark(FieldTileData tile, uint row, uint count) {
    uint words_per_row = (unpacked(tile.size).x + 31u) / 32u;
    uint last = count - 1u;
    atomicXor(scratch[tile.mask + row * words_per_row + last / 32u], 1u << (last & 31u));
}

// The rows between two heights above the tile's centre: the first, and the one after the last.
uvec2 rows_between(FieldTileData tile, float low, float high) {
    float height = float(unpacked(tile.size).y);
    return uvec2(clamp(ceil(vec2(low, high) + (0.5 * height - 0.5)), 0.0, height));
}

void mark_all(FieldTileData tile, float from, float to) {
    uvec2 rows = rows_between(tile, min(from, to), max(from, to));
    for (uint row = rows.x; row < rows.y; ++row) {
        mark(tile, row, unpacked(tile.size).x);
    }
}

void mark_edge(FieldTileData tile, Exact a, Exact b) {
    uvec2 rows = rows_between(tile, min(a.y.x, b.y.x), max(a.y.x, b.y.x));
    if (rows.x >= rows.y) {
        return;
    }
    vec2 size = vec2(unpacked(tile.size));
    SeenEdge edge = seen_edge(a, b);
    float slope = edge.way.x / edge.way.y;
    for (uint row = rows.x; row < rows.y; ++row) {
        float y = float(row) + 0.5 - 0.5 * size.y;
        float x = clamp(edge.nearest.x + (y - edge.nearest.y) * slope, min(a.x.x, b.x.x),
                        max(a.x.x, b.x.x));
        uint count = uint(clamp(ceil(x + (0.5 * size.x - 0.5)), 0.0, size.x));
        if (count > 0u) {
            mark(tile, row, count);
        }
    }
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    FieldTileData tile = tile_at(tile_of(index, by_chunk));
    Shape shape = shape_at(tile.shape);
    uint chunk = index - tile.first_chunk;
    vec4 box = floats_at(word_at(shape.first_boxes) + chunk);
    vec2 middle = 0.5 * (box.xy + box.zw);
    vec2 half_box = 0.5 * (box.zw - box.xy);
    vec2 half_size = 0.5 * vec2(unpacked(tile.size));
    // Relative to the tile's centre; the slack covers the errors of single precision.
    vec2 centre = vec2(tile.axis.x * middle.x - tile.axis.y * middle.y,
                       tile.axis.y * middle.x + tile.axis.x * middle.y) + tile.offset - half_size;
    vec2 reach = vec2(dot(abs(tile.axis), half_box), dot(abs(tile.axis.yx), half_box)) + tile.slack;
    if (abs(centre.y) > reach.y + half_size.y || centre.x + reach.x < -half_size.x) {
        return;
    }
    uint slot = chunk_size * chunk;
    uint end = edges_end(shape, chunk);
    vec4 high = floats_at(shape.edges + slot);
    vec4 low = low_parts(tile, slot);
    Exact a = placed(tile, high.xy, low.xy, half_size);
    if (centre.x - reach.x > half_size.x) {
        high = floats_at(shape.edges + end - 1u);
        low = low_parts(tile, end - 1u);
        mark_all(tile, a.y.x, placed(tile, high.zw, low.zw, half_size).y.x);
        return;
    }
    for (; slot < end; ++slot) {
        high = floats_at(shape.edges + slot);
        low = low_parts(tile, slot);
        Exact b = placed(tile, high.zw, low.zw, half_size);
        mark_edge(tile, a, b);
        a = b;
    }
}
