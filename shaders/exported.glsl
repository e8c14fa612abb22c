// The record of a point that a search has found, as it stays on the device. Include after search.glsl
// and nearfield.glsl.

#include "four_points.glsl"

uint first_edge_along_rings(Shape shape, uint place) {
    return word_at(shape.infos + chunk_along_rings(shape, place)) >> 4;
}

vec4 ends_of(Shape shape, uint edge) {
    uint place = 0u;
    uint count = shape.chunks;
    while (count > 1u) {
        uint half_count = count / 2u;
        bool is_before = first_edge_along_rings(shape, place + half_count) <= edge;
        place += is_before ? half_count : 0u;
        count = is_before ? count - half_count : half_count;
    }
    uint chunk = chunk_along_rings(shape, place);
    uint slot = chunk_size * chunk + edge - (word_at(shape.infos + chunk) >> 4);
    return floats_at(shape.edges + slot);
}

// As search_points.comp has it, in B's frame.
vec2 point_of(SearchDirectionData direction, uvec4 record) {
    vec4 edge = ends_of(shape_at(direction.shape_a), record.y);
    vec2 from = placed(direction, edge.xy);
    vec2 end = placed(direction, edge.zw);
    return from + float(record.z) / float(parts_of(direction, record.y)) * (end - from);
}

// The outward normal of an edge of B, near a point on it; zero if the edge has no length, or if it takes
// too long to tell. Beside a vertex another edge may be in between: the sides are those of a point of
// the edge that is a little away from it.
vec2 normal_of_edge(Shape b, vec4 edge, vec2 point, float margin) {
    vec2 way = edge.zw - edge.xy;
    float size = length(way);
    if (!(size > 0.0)) {
        return vec2(0.0);
    }
    vec2 along = way / size;
    vec2 normal = vec2(-along.y, along.x);
    float aside = 4.0 * margin;
    float from_end = min(64.0 * aside, 0.5 * size);
    float place = clamp(dot(point - edge.xy, along), from_end, size - from_end);
    vec2 beside = edge.xy + place * along + aside * normal;
    bool too_long = false;
    bvec4 inside = find_inside(points_at(beside.xxxx, beside.yyyy), bvec4(true), b, too_long);
    return too_long ? vec2(0.0) : (inside.x ? -normal : normal);
}

// `record`: direction, edge of A, sample on it, word. `frame`: B's in the world, a unit of its x axis
// and its centre.
NearfieldPoint exported(uvec4 record, vec4 frame, uint flags) {
    SearchDirectionData direction = direction_at(record.x);
    Shape b = shape_at(direction.shape_b);
    mat2 to_world = mat2(frame.x, frame.y, -frame.y, frame.x);
    vec2 p = point_of(direction, record);
    vec4 edge = ends_of(b, record.w & point_edge_mask);
    vec2 nearest = nearest_on_segment(p, edge.xy, edge.zw);
    vec2 way = nearest - p;
    float size = length(way);
    bool is_inside = (record.w & point_inside) != 0u;
    bool touches = size <= 2.0 * direction.margin;
    vec2 normal = touches ? normal_of_edge(b, edge, nearest, direction.margin)
                          : (is_inside ? way : -way) / size;
    uint feature = record.w & point_edge_mask;
    feature |= (record.w & point_unique) != 0u ? nearfield_unique_flag : 0u;
    feature |= is_inside && size > abs(direction.touching) ? nearfield_inside_flag : 0u;
    flags |= touches ? nearfield_touching_flag : 0u;
    flags |= (record.w & point_doubtful) != 0u ? nearfield_undecided_flag : 0u;
    float unit = length(frame.xy);
    return NearfieldPoint(to_world * p + frame.zw, to_world * nearest + frame.zw,
                           to_world * normal / unit, length(to_world * way), feature, record.y, flags);
}
