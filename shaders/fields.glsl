// Field tiles (fields.h), and where they lie in B's frame.

#include "push.h"
#include "fields.h"
#include "shapes_in_tiles.glsl"

layout(push_constant) uniform Push { FieldPush push; };

// Which of the numbers of a tile's first elements, by its word.
const uint by_region = 12u;
const uint by_quarter = 13u;
const uint by_block = 14u;
const uint by_row = 18u;

uint tile_unit(uint tile, uint unit) {
    return push.tiles + units_of_field_tile * tile + unit;
}

// The tile that an element belongs to.
uint tile_of(uint index, uint kind) {
    return last_of_input(index, 4u * push.tiles + kind, push.tile_count, 4u * units_of_field_tile);
}

FieldTileData tile_at(uint tile) {
    uvec4 first = unit_at(tile_unit(tile, 3u));
    uvec4 results = unit_at(tile_unit(tile, 4u));
    return FieldTileData(shape_in_tile_at(tile_unit(tile, 0u)), first.x, first.y, first.z, first.w,
                         results.x, uintBitsToFloat(results.y), results.z, uint[1](0u));
}

uvec2 count_along(FieldTileData tile, uint side) {
    return (unpacked(tile.b.size) + side - 1u) / side;
}

// Column and row of an element of a tile: `number` among those of the tile, each with this side.
uvec2 place_of(FieldTileData tile, uint number, uint side) {
    uint across = count_along(tile, side).x;
    return uvec2(number % across, number / across);
}

float scale_of(FieldTileData tile) {
    return length(tile.b.axis);
}

// A point of the tile in B's frame, in single precision.
vec2 in_frame(FieldTileData tile, vec2 cells) {
    vec2 way = cells - tile.b.offset;
    return vec2(dot(tile.b.axis, way), tile.b.axis.x * way.y - tile.b.axis.y * way.x) /
           dot(tile.b.axis, tile.b.axis);
}
