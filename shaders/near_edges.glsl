// Which edges can be nearest somewhere in a square of a field tile. Include after fields.glsl.
//
// The distance to an edge, or to a box around edges, is a convex function: it lies above its tangent at
// the centre, and the excess of another edge's distance over a linear function is largest at a corner.
// An edge whose tangent exceeds the distance to some other edge, the rival, at all four corners is
// nearest nowhere in the square. The edges nearest to the centre and to the corners serve as rivals.

// A square, or rectangle, in B's frame: its centre, and the ways to the middles of two of its sides.
struct Square {
    vec2 centre;
    vec2 across;
    vec2 up;
    vec4 corners_x;
    vec4 corners_y;
};

const vec4 corner_across = vec4(-1.0, 1.0, -1.0, 1.0);
const vec4 corner_up = vec4(-1.0, -1.0, 1.0, 1.0);

// The square of this side in a column and a row of a tile, as far as it lies in the tile.
Square square_at(FieldTileData tile, uvec2 place, uint side) {
    vec2 low = vec2(place * side);
    vec2 high = min(low + float(side), vec2(unpacked(tile.b.size)));
    vec2 half_size = 0.5 * (high - low);
    vec2 axis = tile.b.axis / dot(tile.b.axis, tile.b.axis);
    vec2 centre = in_frame(tile, 0.5 * (low + high));
    vec2 across = half_size.x * vec2(axis.x, -axis.y);
    vec2 up = half_size.y * vec2(axis.y, axis.x);
    return Square(centre, across, up, centre.x + corner_across * across.x + corner_up * up.x,
                  centre.y + corner_across * across.y + corner_up * up.y);
}

vec2 way_from_box(vec2 p, vec4 box) {
    return p - clamp(p, box.xy, box.zw);
}

vec2 way_from_edge(vec2 p, vec4 edge) {
    return p - nearest_on_segment(p, edge.xy, edge.zw);
}

// The nearest edges: their squared distances, and their slots.
struct Rivals {
    float squared;  // from the centre
    uint slot;
    vec4 corner_squared;
    uvec4 corner_slot;
};

const Rivals no_rivals = Rivals(infinity, no_parts, vec4(infinity), uvec4(no_parts));

vec4 corner_distances(Square square, vec4 edge) {
    vec2 d = edge.zw - edge.xy;
    float squared = dot(d, d);
    float inverse = squared > 0.0 ? 1.0 / squared : 0.0;
    vec4 x = square.corners_x - edge.x;
    vec4 y = square.corners_y - edge.y;
    vec4 t = clamp((x * d.x + y * d.y) * inverse, 0.0, 1.0);
    x -= t * d.x;
    y -= t * d.y;
    return x * x + y * y;
}

void consider(Square square, vec4 edge, uint slot, inout Rivals rivals) {
    vec2 way = square.centre - nearest_on_segment(square.centre, edge.xy, edge.zw);
    float squared = dot(way, way);
    rivals.slot = squared < rivals.squared ? slot : rivals.slot;
    rivals.squared = min(squared, rivals.squared);
    vec4 from_corners = corner_distances(square, edge);
    rivals.corner_slot =
        mix(rivals.corner_slot, uvec4(slot), lessThan(from_corners, rivals.corner_squared));
    rivals.corner_squared = min(from_corners, rivals.corner_squared);
}

// Four edges, whose loads do not wait for each other.
vec4[4] edges_at(Shape shape, uvec4 slots) {
    vec4 edges[4];
    for (uint i = 0u; i < 4u; ++i) {
        edges[i] = floats_at(shape.edges + slots[i]);
    }
    return edges;
}

void consider_four(Square square, Shape shape, uvec4 slots, inout Rivals rivals) {
    vec4 edges[4] = edges_at(shape, slots);
    for (uint i = 0u; i < 4u; ++i) {
        consider(square, edges[i], slots[i], rivals);
    }
}

// The distances of the corners from the rivals, with the slack: no edge farther is nearest.
struct Limits {
    vec4 centre;
    vec4 low_left;
    vec4 low_right;
    vec4 high_left;
    vec4 high_right;
};

// The slots of the rivals: the one nearest to the centre, and those nearest to the corners.
Limits limits_of(FieldTileData tile, Shape shape, Square square, uint slot, uvec4 corner_slot) {
    vec4 edge = floats_at(shape.edges + slot);
    float slack = tile.b.slack / scale_of(tile) +
                  length(way_from_edge(square.centre, edge)) / 131072.0;
    return Limits(sqrt(corner_distances(square, edge)) + slack,
                  sqrt(corner_distances(square, floats_at(shape.edges + corner_slot.x))) + slack,
                  sqrt(corner_distances(square, floats_at(shape.edges + corner_slot.y))) + slack,
                  sqrt(corner_distances(square, floats_at(shape.edges + corner_slot.z))) + slack,
                  sqrt(corner_distances(square, floats_at(shape.edges + corner_slot.w))) + slack);
}

// `way`: to the centre from the nearest point of an edge, or of a box.
bool can_be_nearest(Square square, Limits limits, vec2 way) {
    float size = length(way);
    vec2 slope = size > 0.0 ? way / size : vec2(0.0);
    vec4 tangent = size + corner_across * dot(slope, square.across) + corner_up * dot(slope, square.up);
    return any(lessThanEqual(tangent, limits.centre)) && any(lessThanEqual(tangent, limits.low_left)) &&
           any(lessThanEqual(tangent, limits.low_right)) &&
           any(lessThanEqual(tangent, limits.high_left)) &&
           any(lessThanEqual(tangent, limits.high_right));
}

// Which of four edges can be nearest, one bit each.
uint those_nearest(Square square, Shape shape, Limits limits, uvec4 slots) {
    vec4 edges[4] = edges_at(shape, slots);
    uint near = 0u;
    for (uint i = 0u; i < 4u; ++i) {
        bool can_be = can_be_nearest(square, limits, way_from_edge(square.centre, edges[i]));
        near |= can_be ? 1u << i : 0u;
    }
    return near;
}

// The segment of an edge for the cells of a block, relative to the block's low corner; half_size: the
// block's. Farther along the edge than the block is wide, nothing is nearest to a cell.
uvec4 segment_of(SeenEdge edge, vec2 half_size) {
    float reach = 1.5 * float(block_side);
    float from = max(edge.from, -reach);
    float to = min(edge.to, reach);
    vec2 middle = half_size + edge.nearest + 0.5 * (from + to) * edge.way;
    return floatBitsToUint(vec4(middle, 0.5 * (to - from) * edge.way));
}

// Up to this many edges are tested at every cell of a block instead of being culled further.
const uint few_edges = 2u;
