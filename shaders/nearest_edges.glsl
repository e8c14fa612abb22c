// The edges nearest to four points, and what rivals them. Include after search.glsl, Points, least()
// and largest().
//
// One walk tells the three nearest edges of each point. Where the second is near enough to be a rival,
// and the third is not, the second alone is compared; only where the third is near as well, all edges
// are walked again.

struct Nearest {
    vec4 squared;  // distances
    vec4 x;        // from the points to the nearest ones
    vec4 y;
    uvec4 slot;
    vec4 second;  // squared distances of the second nearest edges, and the third
    uvec4 second_slot;
    vec4 third;
};

// The squared lengths of edges that are points as far as single precision can tell.
const float shortest_squared = 1e-24;

// From four points to the nearest ones on edges of their own, from `from` to `to`.
void find_on_edges(Points p, vec4 from_x, vec4 from_y, vec4 to_x, vec4 to_y, out vec4 x, out vec4 y,
                   out vec4 squared) {
    vec4 dx = to_x - from_x;
    vec4 dy = to_y - from_y;
    vec4 length_squared = dx * dx + dy * dy;
    bvec4 is_long = greaterThan(length_squared, vec4(shortest_squared));
    vec4 scaled_x = mix(vec4(0.0), dx / length_squared, is_long);
    vec4 scaled_y = mix(vec4(0.0), dy / length_squared, is_long);
    x = from_x - p.x;
    y = from_y - p.y;
    vec4 along = clamp(-(x * scaled_x + y * scaled_y), 0.0, 1.0);
    x += along * dx;
    y += along * dy;
    squared = x * x + y * y;
}

// The same on one edge.
void find_on_edge(Points p, vec4 edge, out vec4 x, out vec4 y, out vec4 squared) {
    find_on_edges(p, edge.xxxx, edge.yyyy, edge.zzzz, edge.wwww, x, y, squared);
}

void consider_chunk(Points p, Shape b, uint chunk, inout Nearest nearest) {
    uint end = edges_end(b, chunk);
    uint slot = chunk_size * chunk;
    vec4 next = floats_at(b.edges + slot);
    for (; slot < end; ++slot) {
        vec4 ends = next;
        next = floats_at(b.edges + slot + 1u);
        vec4 x, y, squared;
        find_on_edge(p, ends, x, y, squared);
        bvec4 nearer = lessThan(squared, nearest.squared);
        bvec4 is_second = lessThan(squared, nearest.second);
        nearest.third = min(nearest.third, max(squared, nearest.second));
        nearest.second = min(nearest.second, max(squared, nearest.squared));
        nearest.second_slot = mix(mix(nearest.second_slot, uvec4(slot), is_second), nearest.slot,
                                  nearer);
        nearest.squared = min(squared, nearest.squared);
        nearest.x = mix(nearest.x, x, nearer);
        nearest.y = mix(nearest.y, y, nearer);
        nearest.slot = mix(nearest.slot, uvec4(slot), nearer);
    }
}

// The boxes of a walk's group that may hold an edge within `reach` of one of the points.
void enter(inout Walk walk, Points p, Shape b, float reach) {
    Group group = group_of(b, walk.level, walk.group);
    float limit = (p.radius + reach) * (p.radius + reach);
    uint boxes = 0u;
    vec4 next = floats_at(group.first);
    for (uint i = 0u; i < group.count; ++i) {
        vec4 box = next;
        next = floats_at(group.first + i + 1u);
        boxes |= squared_distance_to_box(p.centre, box) <= limit ? 1u << i : 0u;
    }
    add_boxes(walk, boxes);
}

// Returns the nearest edges that are nearer than `limit`; slot is no_parts if there is none. An edge
// that is neither the second nor the third is farther than the nearest by more than `more`.
Nearest find_nearest(Points p, Shape b, vec4 limit, float more, inout bool too_long) {
    vec4 none = vec4(infinity);
    Nearest nearest = Nearest(none, vec4(0.0), vec4(0.0), uvec4(no_parts), none, uvec4(no_parts), none);
    vec4 limit_squared = limit * limit;
    uint considered = nearest_chunk(b, p.centre);  // gives a first bound
    consider_chunk(p, b, considered, nearest);
    Walk walk = start_walk(b);
    for (uint steps = 0u; steps < max_steps && !too_long; ++steps) {
        enter(walk, p, b, sqrt(largest(min(nearest.squared, limit_squared))) + more);
        uint chunks = take_chunks(walk);
        chunks &= walk.group == considered / chunk_size ? ~(1u << considered % chunk_size) : ~0u;
        steps += bitCount(chunks);
        while (chunks != 0u) {
            consider_chunk(p, b, chunk_size * walk.group + take_bit(chunks), nearest);
        }
        uint box;
        if (!next_box(walk, box)) {
            nearest.slot = mix(uvec4(no_parts), nearest.slot,
                               lessThan(nearest.squared, limit_squared));
            nearest.squared = min(nearest.squared, limit_squared);
            return nearest;
        }
        descend(walk, box);
    }
    too_long = true;
    return nearest;
}

struct Rivals {
    bvec4 exist;
    bvec4 doubtful;
};

// A second boundary point that is as near as the nearest one, up to the margin, is a rival if it is
// more than twice as far from it as one straight edge explains. A second edge that is as near, up to
// rounding, leaves both in doubt, except for a neighbour with the same nearest point. `number`: of the
// second edges; `x`, `y`, `squared`: as find_on_edges() has them.
void compare(vec4 x, vec4 y, vec4 squared, uvec4 number, Nearest nearest, vec4 near, uvec4 edge,
             SearchDirectionData direction, inout Rivals rivals) {
    vec4 limit = near + direction.rival;
    vec4 along_wall = direction.rival * (limit + near);  // limit^2 - distance^2
    float same = 16.0 * direction.margin * direction.margin;
    vec4 distances = sqrt(squared);
    vec4 apart = (x - nearest.x) * (x - nearest.x) + (y - nearest.y) * (y - nearest.y);
    uvec4 exist = uvec4(lessThanEqual(distances, limit)) &
                  uvec4(greaterThan(apart, 4.0 * along_wall));
    uvec4 elsewhere = uvec4(lessThan(number + 1u, edge)) | uvec4(greaterThan(number, edge + 1u)) |
                      uvec4(greaterThan(apart, vec4(same)));
    rivals.exist = bvec4(uvec4(rivals.exist) | exist);
    rivals.doubtful = bvec4(uvec4(rivals.doubtful) |
                            uvec4(lessThanEqual(distances, near + direction.doubt)) & elsewhere);
}

void compare_chunk(Points p, Shape b, uint chunk, Nearest nearest, vec4 near, uvec4 edge,
                   SearchDirectionData direction, inout Rivals rivals) {
    uint first = word_at(b.infos + chunk) >> 4;
    uint end = edges_end(b, chunk);
    uint slot = chunk_size * chunk;
    vec4 next = floats_at(b.edges + slot);
    for (; slot < end; ++slot) {
        vec4 ends = next;
        next = floats_at(b.edges + slot + 1u);
        vec4 x, y, squared;
        find_on_edge(p, ends, x, y, squared);
        compare(x, y, squared, uvec4(first + slot % chunk_size), nearest, near, edge, direction,
                rivals);
    }
}

// The second nearest edges alone.
void compare_second(Points p, Shape b, Nearest nearest, bvec4 asked, vec4 near, uvec4 edge,
                    SearchDirectionData direction, inout Rivals rivals) {
    vec4 from_x, from_y, to_x, to_y;
    uvec4 number;
    for (int i = 0; i < 4; ++i) {
        uint slot = asked[i] ? nearest.second_slot[i] : nearest.slot[i];
        slot = slot == no_parts ? 0u : slot;
        vec4 ends = floats_at(b.edges + slot);
        from_x[i] = ends.x;
        from_y[i] = ends.y;
        to_x[i] = ends.z;
        to_y[i] = ends.w;
        number[i] = number_of(b, slot);
    }
    vec4 x, y, squared;
    find_on_edges(p, from_x, from_y, to_x, to_y, x, y, squared);
    compare(x, y, mix(vec4(infinity), squared, asked), number, nearest, near, edge, direction, rivals);
}

// Precondition: find_nearest() has been called with `more`.
Rivals find_rivals(Points p, Shape b, Nearest nearest, uvec4 edge, SearchDirectionData direction,
                   float more, inout bool too_long) {
    // What is beyond it is beyond the limits of compare(), whatever that rounds.
    const float beyond_rounding = 1.00001;
    Rivals rivals = Rivals(bvec4(false), bvec4(false));
    vec4 near = sqrt(nearest.squared);
    vec4 limit = beyond_rounding * (near + more) * (near + more);
    uvec4 found = uvec4(notEqual(nearest.slot, uvec4(no_parts)));
    bvec4 has_second = bvec4(found & uvec4(lessThanEqual(nearest.second, limit)));
    bvec4 has_third = bvec4(found & uvec4(lessThanEqual(nearest.third, limit)));
    if (!any(has_third)) {
        if (any(has_second)) {
            compare_second(p, b, nearest, has_second, near, edge, direction, rivals);
        }
        return rivals;
    }
    float reach = largest(near) + more;
    Walk walk = start_walk(b);
    for (uint steps = 0u; steps < max_steps && !too_long; ++steps) {
        enter(walk, p, b, reach);
        uint chunks = take_chunks(walk);
        steps += bitCount(chunks);
        while (chunks != 0u) {
            uint chunk = chunk_size * walk.group + take_bit(chunks);
            compare_chunk(p, b, chunk, nearest, near, edge, direction, rivals);
        }
        uint box;
        if (!next_box(walk, box)) {
            return rivals;
        }
        descend(walk, box);
    }
    too_long = true;
    return rivals;
}
