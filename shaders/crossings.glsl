// Whether two segments meet, or are within reach, as far as single precision can tell. Include after
// shapes.glsl.

float cross_product(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// Whether both ends of a segment are on the same side of another's line and farther from it than a
// length. `areas`: twice those of the triangles of the other with each end. `limit`: the length times
// one that is not below the other's.
bool are_on_one_side(vec2 areas, float limit) {
    return min(areas.x, areas.y) > limit || max(areas.x, areas.y) < -limit;
}

// The same on opposite sides.
bool are_on_two_sides(vec2 areas, float limit) {
    return min(areas.x, areas.y) < -limit && max(areas.x, areas.y) > limit;
}

// The least distance of an end of either segment from the other.
float distance_of_ends(vec2 a, vec2 b, vec4 edge) {
    float of_edge = min(distance(edge.xy, nearest_on_segment(edge.xy, a, b)),
                        distance(edge.zw, nearest_on_segment(edge.zw, a, b)));
    float of_own = min(distance(a, nearest_on_segment(a, edge.xy, edge.zw)),
                       distance(b, nearest_on_segment(b, edge.xy, edge.zw)));
    return min(of_edge, of_own);
}

// What is near, and what is far, for certain; and how far from each other's lines are the ends of
// segments that cross for certain.
struct Limits {
    float near;
    float far;
    float margin;
};

// Of the segments from `a` to `b` and along `edge`.
uint verdict_on(vec2 a, vec2 b, vec4 edge, Limits limits) {
    vec2 along = b - a;
    vec2 other = edge.zw - edge.xy;
    // The sum of the components does not vanish where their squares would.
    float size = abs(along.x) + abs(along.y);
    float other_size = abs(other.x) + abs(other.y);
    vec2 ends = vec2(cross_product(along, edge.xy - a), cross_product(along, edge.zw - a));
    vec2 own_ends = vec2(cross_product(other, a - edge.xy), cross_product(other, b - edge.xy));
    vec2 gap = max(min(a, b), min(edge.xy, edge.zw)) - min(max(a, b), max(edge.xy, edge.zw));
    if (max(gap.x, gap.y) > limits.far || are_on_one_side(ends, limits.far * size) ||
        are_on_one_side(own_ends, limits.far * other_size)) {
        return 0u;
    }
    if (are_on_two_sides(ends, limits.margin * size) &&
        are_on_two_sides(own_ends, limits.margin * other_size)) {
        return pair_meets;
    }
    // Of segments that cross without being known to, an end is no farther from the other than the
    // margin times the ratio of the sum to the length, which is at most the root of 2.
    float nearest = distance_of_ends(a, b, edge);
    return nearest <= limits.near                       ? pair_meets
           : nearest <= limits.far + 0.5 * limits.margin ? pair_in_doubt
                                                         : 0u;
}
