// Four points at once, and the side of a boundary on which they lie. Include after search.glsl.

// In B's frame, and a disc that holds them.
struct Points {
    vec4 x;
    vec4 y;
    vec2 centre;
    float radius;
};

float least(vec4 v) {
    return min(min(v.x, v.y), min(v.z, v.w));
}

float largest(vec4 v) {
    return max(max(v.x, v.y), max(v.z, v.w));
}

Points points_at(vec4 x, vec4 y) {
    vec2 low = vec2(least(x), least(y));
    vec2 high = vec2(largest(x), largest(y));
    return Points(x, y, 0.5 * (low + high), 0.5 * distance(low, high));
}

bvec4 cross_edge(Points p, vec4 edge) {
    // Half-open in y, so a vertex on the ray counts once.
    float slope = (edge.z - edge.x) / (edge.w - edge.y);
    vec4 x = edge.x + (p.y - edge.y) * slope;
    uvec4 spans = uvec4(greaterThan(vec4(edge.y), p.y)) ^ uvec4(greaterThan(vec4(edge.w), p.y));
    return bvec4(spans & uvec4(lessThan(p.x, x)));
}

// The points that lie inside, of those that are asked for; the others do.
bvec4 find_inside(Points p, bvec4 asked, Shape b, inout bool too_long) {
    if (!any(asked)) {
        return bvec4(true);
    }
    // The rays of those that are asked for go to growing x.
    float lowest = least(mix(vec4(infinity), p.y, asked));
    float highest = largest(mix(vec4(-infinity), p.y, asked));
    float leftmost = least(mix(vec4(infinity), p.x, asked));
    uvec4 odd = uvec4(0u);
    Walk walk = start_walk(b);
    for (uint steps = 0u; steps < max_steps; ++steps) {
        Group group = group_of(b, walk.level, walk.group);
        uint boxes = 0u;
        vec4 next_box_of_group = floats_at(group.first);
        for (uint i = 0u; i < group.count; ++i) {
            vec4 box = next_box_of_group;
            next_box_of_group = floats_at(group.first + i + 1u);
            bool visit = highest >= box.y && lowest <= box.w && leftmost <= box.z;
            boxes |= visit ? 1u << i : 0u;
        }
        add_boxes(walk, boxes);
        uint chunks = take_chunks(walk);
        steps += bitCount(chunks);
        while (chunks != 0u) {
            uint chunk = chunk_size * walk.group + take_bit(chunks);
            uint end = edges_end(b, chunk);
            uint slot = chunk_size * chunk;
            vec4 next = floats_at(b.edges + slot);
            for (; slot < end; ++slot) {
                vec4 edge = next;
                next = floats_at(b.edges + slot + 1u);
                odd ^= uvec4(cross_edge(p, edge));
            }
        }
        uint box;
        if (!next_box(walk, box)) {
            return bvec4(odd | uvec4(not(asked)));
        }
        descend(walk, box);
    }
    too_long = true;
    return bvec4(false);
}
