// Field tiles (fields.h), and where they lie in B's frame.

#include "push.h"
#include "fields.h"
#include "shapes_in_tiles.glsl"

layout(push_constant) uniform Push { FieldPush push; };

// Which of the three numbers of a tile's first elements.
const uint by_region = 0u;
const uint by_quarter = 1u;
const uint by_block = 2u;

uint tile_unit(uint tile, uint unit) {
    return push.tiles + units_of_field_tile * tile + unit;
}

// The tile that an element belongs to.
uint tile_of(uint index, uint kind) {
    uint tile = 0u;
    uint count = push.tile_count;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (unit_at(tile_unit(tile + half_count, 3u))[kind] <= index) {
            tile += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    return tile;
}

FieldTileData tile_at(uint tile) {
    uvec4 first = unit_at(tile_unit(tile, 3u));
    uvec4 results = unit_at(tile_unit(tile, 4u));
    return FieldTileData(shape_in_tile_at(tile_unit(tile, 0u)), first.x, first.y, first.z, first.w,
                         results.x, uintBitsToFloat(results.y), uint[2](0u, 0u));
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
