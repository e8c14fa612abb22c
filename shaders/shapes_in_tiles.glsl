// Shapes as tiles see them (compute_work.h): their edges in cells, relative to a place in the tile.
// Shapes are read as the searches read them.

#include "compute_work.h"
#include "shapes.glsl"

ShapeInTileData shape_in_tile_at(uint unit) {
    vec4 axis = floats_at(unit);
    vec4 offset = floats_at(unit + 1u);
    uvec4 own = unit_at(unit + 2u);
    return ShapeInTileData(axis.xy, axis.zw, offset.xy, offset.zw, own.x, own.y, own.z,
                           uintBitsToFloat(own.w));
}

// Sums of two floats, the second below the rounding of the first: about 48 bits. Dekker 1971, Knuth.
vec2 sum_of(float a, float b) {
    precise float sum = a + b;
    precise float part = sum - a;
    precise float error = (a - (sum - part)) + (b - part);
    return vec2(sum, error);
}

vec2 normalised(float a, float b) {
    precise float sum = a + b;
    precise float error = b - (sum - a);
    return vec2(sum, error);
}

vec2 halves_of(float a) {
    precise float scaled = 4097.0 * a;
    precise float high = scaled - (scaled - a);
    precise float low = a - high;
    return vec2(high, low);
}

vec2 product_of(float a, float b) {
    vec2 s = halves_of(a);
    vec2 t = halves_of(b);
    precise float product = a * b;
    precise float error = ((s.x * t.x - product) + s.x * t.y + s.y * t.x) + s.y * t.y;
    return vec2(product, error);
}

vec2 add(vec2 a, vec2 b) {
    vec2 sum = sum_of(a.x, b.x);
    precise float low = sum.y + (a.y + b.y);
    return normalised(sum.x, low);
}

vec2 times(vec2 a, vec2 b) {
    vec2 product = product_of(a.x, b.x);
    precise float low = product.y + (a.x * b.y + a.y * b.x);
    return normalised(product.x, low);
}

// A point in cells: x and y as sums of two floats.
struct Exact {
    vec2 x;
    vec2 y;
};

// A point of the shape's frame, in cells relative to a place in the tile. Equal for equal vertices.
Exact placed(ShapeInTileData in_tile, vec2 high, vec2 low, vec2 place) {
    vec2 x = vec2(high.x, low.x);
    vec2 y = vec2(high.y, low.y);
    vec2 axis_x = vec2(in_tile.axis.x, in_tile.axis_low.x);
    vec2 axis_y = vec2(in_tile.axis.y, in_tile.axis_low.y);
    vec2 offset_x = add(vec2(in_tile.offset.x, in_tile.offset_low.x), vec2(-place.x, 0.0));
    vec2 offset_y = add(vec2(in_tile.offset.y, in_tile.offset_low.y), vec2(-place.y, 0.0));
    return Exact(add(add(times(axis_x, x), -times(axis_y, y)), offset_x),
                 add(add(times(axis_y, x), times(axis_x, y)), offset_y));
}

// What the coordinates of a slot's edge lack, as the coordinates themselves, behind all else.
vec4 low_parts(ShapeInTileData in_tile, uint slot) {
    uvec4 rings = unit_at(in_tile.shape + unit_of_rings);
    return floats_at(rings.y / 4u + (rings.x + 3u) / 4u + slot);
}

// An edge as seen from a place: its nearest point, relative to the place, its direction, and how far
// it extends from that point, against the direction and along it. In cells.
struct SeenEdge {
    vec2 nearest;
    vec2 way;
    float from;
    float to;
};

// The point a + t * (b - a), in single precision. `t`: a sum of two floats.
vec2 point_between(Exact a, vec2 dx, vec2 dy, vec2 t) {
    return vec2(add(a.x, times(t, dx)).x, add(a.y, times(t, dy)).x);
}

SeenEdge seen_edge(Exact a, Exact b) {
    vec2 dx = add(b.x, -a.x);
    vec2 dy = add(b.y, -a.y);
    vec2 d = vec2(dx.x, dy.x);
    vec2 start = vec2(a.x.x, a.y.x);
    vec2 end = vec2(b.x.x, b.y.x);
    float squared = dot(d, d);
    if (!(squared > 0.0)) {
        return SeenEdge(start, vec2(1.0, 0.0), 0.0, 0.0);
    }
    float size = sqrt(squared);
    vec2 way = d / size;
    // In two steps: of an edge of millions of cells, one float does not tell a place to the cell.
    float t = clamp(-dot(start, d) / squared, 0.0, 1.0);
    vec2 first = point_between(a, dx, dy, vec2(t, 0.0));
    float more = -dot(first, way);
    if (more <= dot(start - first, way)) {
        return SeenEdge(start, way, 0.0, size);
    }
    if (more >= dot(end - first, way)) {
        return SeenEdge(end, way, -size, 0.0);
    }
    vec2 nearest = point_between(a, dx, dy, sum_of(t, more / size));
    return SeenEdge(nearest, way, min(dot(start - nearest, way), 0.0),
                    max(dot(end - nearest, way), 0.0));
}

SeenEdge edge_seen_from(ShapeInTileData in_tile, Shape shape, uint slot, vec2 place) {
    vec4 high = floats_at(shape.edges + slot);
    vec4 low = low_parts(in_tile, slot);
    return seen_edge(placed(in_tile, high.xy, low.xy, place), placed(in_tile, high.zw, low.zw, place));
}
