#version 450
#extension GL_GOOGLE_include_directive : require

// The signed distance at every cell of a field (section 2.2.2 of the paper), from the segments that
// can be nearest in the cell's block. Eight threads per block, two columns per thread: each segment
// read serves 32 cells, and neighbouring threads write neighbouring words.
//
// In the frame of a segment (origin in its middle, one axis along it) a cell has one coordinate
// along the segment and one across it. The distance is the one across, combined beyond an end with
// the distance along to that end. Both coordinates change by constant steps from row to row.

#include "fields.glsl"

layout(local_size_x = group_size) in;

layout(std430, set = 0, binding = 1) readonly buffer Scratch {
    uint scratch[];
};
layout(std430, set = 0, binding = 1) readonly buffer ScratchUnits {
    uvec4 scratch_units[];  // the same memory
};
layout(std430, set = 0, binding = 3) writeonly buffer Field {
    uint words[];
} field;

const float columns_apart = float(threads_per_block);
const vec4 rows = vec4(0.0, 1.0, 2.0, 3.0);

// Squared distances of 16 cells above each other, as bits: non-negative floats have the same order
// as their bits, and the integer minimum is cheaper.
struct Column {
    uvec4 rows_0, rows_4, rows_8, rows_12;
};

const uint infinity_bits = 0x7f800000u;
const Column nothing_near =
    Column(uvec4(infinity_bits), uvec4(infinity_bits), uvec4(infinity_bits), uvec4(infinity_bits));

uvec4 squared_distance(vec4 along, vec4 across, float half_length) {
    vec4 beyond = max(abs(along) - half_length, 0.0);
    return floatBitsToUint(across * across + beyond * beyond);
}

// Updates a column with a segment along the unit vector `way`. `from_middle`: from the segment's
// middle to the column's lowest cell.
void consider(vec2 from_middle, vec2 way, float half_length, inout Column column) {
    vec4 along = dot(from_middle, way) + rows * way.y;
    vec4 across = from_middle.x * way.y - from_middle.y * way.x - rows * way.x;
    column.rows_0 = min(column.rows_0, squared_distance(along, across, half_length));
    along += 4.0 * way.y;
    across -= 4.0 * way.x;
    column.rows_4 = min(column.rows_4, squared_distance(along, across, half_length));
    along += 4.0 * way.y;
    across -= 4.0 * way.x;
    column.rows_8 = min(column.rows_8, squared_distance(along, across, half_length));
    along += 4.0 * way.y;
    across -= 4.0 * way.x;
    column.rows_12 = min(column.rows_12, squared_distance(along, across, half_length));
}

// Updates two columns, the first of which begins at a cell.
void consider_segment(uint index, vec2 cell, inout Column left, inout Column right) {
    vec4 segment = uintBitsToFloat(scratch_units[index]);
    float squared = dot(segment.zw, segment.zw);
    float inverse = squared > 0.0 ? inversesqrt(squared) : 0.0;
    // For a segment of length 0 any direction is valid.
    vec2 way = squared > 0.0 ? segment.zw * inverse : vec2(1.0, 0.0);
    vec2 from_middle = cell - segment.xy;
    consider(from_middle, way, squared * inverse, left);
    consider(from_middle + vec2(columns_apart, 0.0), way, squared * inverse, right);
}

void write(uint word, uint squared, bool inside) {
    float value = sqrt(uintBitsToFloat(squared));
    field.words[word] = floatBitsToUint(inside ? -value : value);
}

// Where the values and the signs of a block's lowest row go and lie, and the bit of its low cell.
struct Rows {
    uint value;
    uint stride;
    uint sign;
    uint first_sign;
    uint words_per_row;
    uvec2 size;
};

void write_rows(Rows block, uint row, uint x, uvec4 left, uvec4 right) {
    uint beside = x + threads_per_block;
    for (uint i = 0u; i < 4u; ++i) {
        if (row + i < block.size.y) {
            uint signs = scratch[block.sign + (row + i) * block.words_per_row] >> block.first_sign;
            uint word = block.value + (row + i) * block.stride + x;
            write(word, left[i], (signs >> x & 1u) != 0u);
            if (beside < block.size.x) {
                write(word + threads_per_block, right[i], (signs >> beside & 1u) != 0u);
            }
        }
    }
}

void main() {
    uint index = push.first + gl_GlobalInvocationID.x;
    if (index >= push.end) {
        return;
    }
    uint number = index / threads_per_block;
    uint x = index % threads_per_block;
    FieldTileData tile = tile_at(tile_of(number, by_block));
    uvec2 low = block_side * place_of(tile, number - tile.first_block, block_side);
    uvec2 tile_size = unpacked(tile.b.size);
    uvec2 size = min(tile_size - low, uvec2(block_side));
    uint first = push.segments + scratch[push.blocks + 2u * number];
    uint count = scratch[push.blocks + 2u * number + 1u];
    if (tile.first_value == not_asked || x >= size.x || count == crowded) {
        return;
    }
    Column left = nothing_near;
    Column right = nothing_near;
    vec2 cell = vec2(float(x) + 0.5, 0.5);
    for (uint i = 0u; i < count; ++i) {
        consider_segment(first + i, cell, left, right);
    }
    uint words_per_row = (tile_size.x + 31u) / 32u;
    Rows block = Rows(tile.first_value + low.y * tile_size.x + low.x, tile_size.x,
                      tile.b.mask + low.y * words_per_row + low.x / 32u, low.x % 32u, words_per_row,
                      size);
    write_rows(block, 0u, x, left.rows_0, right.rows_0);
    write_rows(block, 4u, x, left.rows_4, right.rows_4);
    write_rows(block, 8u, x, left.rows_8, right.rows_8);
    write_rows(block, 12u, x, left.rows_12, right.rows_12);
}
