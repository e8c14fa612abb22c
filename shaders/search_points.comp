#version 450
#extension GL_GOOGLE_include_directive : require

// The search's third step, one thread per four points of A's boundary, which share the edges that
// it loads: the side of B's boundary on which a point lies where that is not known, the nearest edge
// of B, and what single precision leaves in doubt.

#include "search.glsl"
#include "block_sum.glsl"

layout(local_size_x = group_size) in;

// Four points, in B's frame, and a disc that holds them.
struct Points {
    vec4 x;
    vec4 y;
    vec2 centre;
    float radius;
};

struct Nearest {
    vec4 squared;  // distances
    vec4 x;        // the nearest points
    vec4 y;
    uvec4 slot;
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

float distance_to_box(vec2 p, vec4 box) {
    return length(max(max(box.xy - p, p - box.zw), vec2(0.0)));
}

// Of four points, the nearest ones on an edge.
void find_on_edge(Points p, vec4 edge, out vec4 x, out vec4 y, out vec4 squared) {
    vec2 d = edge.zw - edge.xy;
    float length_squared = dot(d, d);
    vec4 along = length_squared > 0.0 ? clamp(((p.x - edge.x) * d.x + (p.y - edge.y) * d.y) /
                                                  length_squared, 0.0, 1.0)
                                      : vec4(0.0);
    x = edge.x + along * d.x;
    y = edge.y + along * d.y;
    squared = (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y);
}

bvec4 cross_edge(Points p, vec4 edge) {
    // Half-open in y, so a vertex on the ray counts once.
    vec4 x = edge.x + (p.y - edge.y) / (edge.w - edge.y) * (edge.z - edge.x);
    uvec4 spans = uvec4(greaterThan(vec4(edge.y), p.y)) ^ uvec4(greaterThan(vec4(edge.w), p.y));
    return bvec4(spans & uvec4(lessThan(p.x, x)));
}

// The points that lie inside, of those that are asked for; the others do.
bvec4 find_inside(Points p, bvec4 asked, Shape b, inout bool too_long) {
    // The rays of those that are asked for go to growing x.
    float lowest = least(mix(vec4(infinity), p.y, asked));
    float highest = largest(mix(vec4(-infinity), p.y, asked));
    float leftmost = least(mix(vec4(infinity), p.x, asked));
    uvec4 odd = uvec4(0u);
    Walk walk = start_walk(b);
    bool enters = any(asked);
    for (uint step = 0u; step < max_steps; ++step) {
        if (enters) {
            Group group = group_of(b, walk.level, walk.group);
            uint boxes = 0u;
            for (uint i = 0u; i < group.count; ++i) {
                vec4 box = floats_at(group.first + i);
                bool visit = highest >= box.y && lowest <= box.w && leftmost <= box.z;
                boxes |= visit ? 1u << i : 0u;
            }
            add_boxes(walk, boxes);
        }
        uint box;
        if (!next_box(walk, box)) {
            return bvec4(odd | uvec4(not(asked)));
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
            continue;
        }
        uint end = edges_end(b, box);
        for (uint slot = chunk_size * box; slot < end; ++slot) {
            odd ^= uvec4(cross_edge(p, floats_at(b.edges + slot)));
        }
    }
    too_long = true;
    return bvec4(false);
}

void consider_chunk(Points p, Shape b, uint chunk, inout Nearest nearest) {
    uint end = edges_end(b, chunk);
    for (uint slot = chunk_size * chunk; slot < end; ++slot) {
        vec4 x, y, squared;
        find_on_edge(p, floats_at(b.edges + slot), x, y, squared);
        bvec4 nearer = lessThan(squared, nearest.squared);
        nearest.squared = min(squared, nearest.squared);
        nearest.x = mix(nearest.x, x, nearer);
        nearest.y = mix(nearest.y, y, nearer);
        nearest.slot = mix(nearest.slot, uvec4(slot), nearer);
    }
}

// Follows the nearest box from level to level: a first bound for the search. Returns the chunk.
uint descend_to_nearest(Points p, Shape b, inout Nearest nearest) {
    uint box = 0u;
    for (uint level = b.levels; level > 0u; --level) {
        Group group = group_of(b, level - 1u, box);
        uint best = 0u;
        float least_distance = infinity;
        for (uint i = 0u; i < group.count; ++i) {
            float d = distance_to_box(p.centre, floats_at(group.first + i));
            best = d < least_distance ? i : best;
            least_distance = min(d, least_distance);
        }
        box = chunk_size * box + best;
    }
    consider_chunk(p, b, box, nearest);
    return box;
}

// The boxes of a walk's group that may hold an edge within `reach` of one of the points.
void enter(inout Walk walk, Points p, Shape b, float reach) {
    Group group = group_of(b, walk.level, walk.group);
    uint boxes = 0u;
    for (uint i = 0u; i < group.count; ++i) {
        vec4 box = floats_at(group.first + i);
        boxes |= distance_to_box(p.centre, box) <= p.radius + reach ? 1u << i : 0u;
    }
    add_boxes(walk, boxes);
}

// Returns the nearest edges that are nearer than `limit`; slot is no_parts if there is none.
Nearest find_nearest(Points p, Shape b, vec4 limit, inout bool too_long) {
    Nearest nearest = Nearest(limit * limit, vec4(0.0), vec4(0.0), uvec4(no_parts));
    uint considered = descend_to_nearest(p, b, nearest);
    Walk walk = start_walk(b);
    bool enters = true;
    for (uint i = 0u; i < max_steps && !too_long; ++i) {
        if (enters) {
            enter(walk, p, b, sqrt(largest(nearest.squared)));
        }
        uint box;
        if (!next_box(walk, box)) {
            return nearest;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
        } else if (box != considered) {
            consider_chunk(p, b, box, nearest);
        }
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
// rounding, leaves both in doubt, except for a neighbour with the same nearest point.
void compare_chunk(Points p, Shape b, uint chunk, Nearest nearest, vec4 near, uvec4 edge,
                   SearchDirectionData direction, inout Rivals rivals) {
    vec4 limit = near + direction.rival;
    vec4 along_wall = direction.rival * (limit + near);  // limit^2 - distance^2
    vec4 in_doubt = near + direction.doubt;
    float same = 16.0 * direction.margin * direction.margin;
    uint first = word_at(b.infos + chunk) >> 4;
    uint end = edges_end(b, chunk);
    for (uint slot = chunk_size * chunk; slot < end; ++slot) {
        vec4 x, y, squared;
        find_on_edge(p, floats_at(b.edges + slot), x, y, squared);
        vec4 distances = sqrt(squared);
        vec4 apart = (x - nearest.x) * (x - nearest.x) + (y - nearest.y) * (y - nearest.y);
        uvec4 number = uvec4(first + slot % chunk_size);
        uvec4 exist = uvec4(lessThanEqual(distances, limit)) &
                      uvec4(greaterThan(apart, 4.0 * along_wall));
        uvec4 elsewhere = uvec4(lessThan(number + 1u, edge)) |
                          uvec4(greaterThan(number, edge + 1u)) |
                          uvec4(greaterThan(apart, vec4(same)));
        rivals.exist = bvec4(uvec4(rivals.exist) | exist);
        rivals.doubtful = bvec4(uvec4(rivals.doubtful) |
                                uvec4(lessThanEqual(distances, in_doubt)) & elsewhere);
    }
}

Rivals find_rivals(Points p, Shape b, Nearest nearest, uvec4 edge, SearchDirectionData direction,
                   inout bool too_long) {
    Rivals rivals = Rivals(bvec4(false), bvec4(false));
    vec4 near = sqrt(nearest.squared);
    float reach = largest(near) + max(direction.rival, direction.doubt);
    Walk walk = start_walk(b);
    bool enters = true;
    for (uint i = 0u; i < max_steps && !too_long; ++i) {
        if (enters) {
            enter(walk, p, b, reach);
        }
        uint box;
        if (!next_box(walk, box)) {
            return rivals;
        }
        enters = walk.level > 0u;
        if (enters) {
            descend(walk, box);
        } else {
            compare_chunk(p, b, box, nearest, near, edge, direction, rivals);
        }
    }
    too_long = true;
    return rivals;
}

// Returns the words of four points; 0 for those that are not asked for. `depth`: 0 outside;
// negative where a walk takes too long.
uvec4 resolve(Points p, bvec4 asked, SearchDirectionData direction, out vec4 depth) {
    Shape b = shape_at(direction.shape_b);
    bool too_long = false;
    bvec4 inside = find_inside(p, asked, b, too_long);
    float near_boundary = 2.0 * direction.margin;
    vec4 limit = direction.outside != 0.0 ? vec4(direction.reach + near_boundary)
                                   : mix(vec4(near_boundary), vec4(infinity), inside);
    Nearest nearest = find_nearest(p, b, limit, too_long);
    uvec4 found = uvec4(notEqual(nearest.slot, uvec4(no_parts)));
    uvec4 edge;
    for (int i = 0; i < 4; ++i) {
        edge[i] = found[i] != 0u ? number_of(b, nearest.slot[i]) : 0u;
    }
    Rivals rivals = Rivals(bvec4(false), bvec4(false));
    if (found != uvec4(0u)) {
        rivals = find_rivals(p, b, nearest, edge, direction, too_long);
    }
    depth = too_long ? vec4(-1.0) : mix(vec4(0.0), sqrt(nearest.squared), inside);
    if (too_long) {
        return point_resolved | point_doubtful | edge;
    }
    uvec4 doubtful = uvec4(rivals.doubtful) |
                     uvec4(lessThanEqual(nearest.squared, vec4(near_boundary * near_boundary)));
    return found * (point_resolved | uvec4(inside) * point_inside |
                    uvec4(not(rivals.exist)) * point_unique | doubtful * point_doubtful | edge);
}

// A place among the points that the step before has found: an edge of A, and a point on it.
struct Place {
    uint element;  // of that step
    uvec4 edge;    // what it wrote
    uvec4 asked;
    uint point;
};

void load(inout Place place) {
    uint unit = push.edge_units + 2u * place.element;
    place.edge = scratch_units[unit];
    place.asked = scratch_units[unit + 1u];
    place.point = place.edge.z;
}

Place place_of(uint index) {
    uint edges = scratch[edge_total];
    uint block = block_of(index, push.edge_blocks, edges);
    uint rest = index - scratch[push.edge_blocks + block];
    uint low = block * search_block;
    // The last word of the first of two units.
    uint first = 4u * (push.edge_units + 2u * low) + 3u;
    Place place;
    place.element = low + last_at_most(rest, first, min(search_block, edges - low), 8u, 0u);
    load(place);
    place.point += rest - place.edge.w;
    return place;
}

// Moves on to the next point, which has this index. There has to be one.
void advance(inout Place place, uint index) {
    ++place.point;
    if (place.point == place.edge.z + place.asked.z) {
        ++place.element;
        load(place);
        if (place.asked.z == 0u) {
            place = place_of(index);
        }
    }
}

// The points of one thread.
struct Batch {
    uvec4 direction;
    uvec4 slot;
    uvec4 number;  // among the points of the edge
    bvec4 asked;
};

Batch batch_at(uint index, uint count) {
    Batch batch;
    Place place = place_of(index);
    for (uint i = 0u; i < points_per_thread; ++i) {
        batch.direction[i] = place.edge.x;
        batch.slot[i] = place.edge.y;
        batch.number[i] = place.point;
        batch.asked[i] = place.point >= place.asked.x && place.point < place.asked.y;
        if (i + 1u < count) {
            advance(place, index + i + 1u);
        }
    }
    return batch;
}

// Resolves the points from `first` on that have the same direction, and moves `first` behind them.
void resolve_run(Batch batch, uint count, inout uint first, inout uvec4 edges, inout uvec4 words,
                 inout vec4 depths) {
    uint index = batch.direction[first];
    SearchDirectionData direction = direction_at(index);
    Shape a = shape_at(direction.shape_a);
    vec4 x, y;
    bvec4 asked;
    bvec4 own = bvec4(false);
    // The places of others are filled with the first point, which changes nothing.
    for (uint i = 0u; i < points_per_thread; ++i) {
        own[i] = i >= first && i < count && batch.direction[i] == index;
        uint source = own[i] ? i : first;
        vec4 edge = floats_at(a.edges + batch.slot[source]);
        uint number = number_of(a, batch.slot[source]);
        float along = float(batch.number[source]) / float(parts_of(direction, number));
        vec2 from = placed(direction, edge.xy);
        vec2 end = placed(direction, edge.zw);
        vec2 p = from + along * (end - from);
        x[i] = p.x;
        y[i] = p.y;
        asked[i] = batch.asked[source];
        edges[i] = own[i] ? number : edges[i];
    }
    vec4 depth;
    words = mix(words, resolve(points_at(x, y), asked, direction, depth), own);
    depths = mix(depths, depth, own);
    while (first < count && batch.direction[first] == index) {
        ++first;
    }
}

void main() {
    uint thread = dispatched_index();
    uint index = points_per_thread * thread;
    uint total = scratch[point_total];
    uint count = index < total ? min(points_per_thread, total - index) : 0u;
    uvec4 edges = uvec4(0u);
    uvec4 words = uvec4(0u);
    vec4 depths = vec4(0.0);
    Batch batch;
    if (count > 0u) {
        batch = batch_at(index, count);
        for (uint first = 0u; first < count;) {
            resolve_run(batch, count, first, edges, words, depths);
        }
    }
    uvec4 found = uvec4(notEqual(words, uvec4(0u)));
    uint before = sum_before(found.x + found.y + found.z + found.w,
                             push.point_blocks + thread / search_block);
    for (uint i = 0u; i < count; ++i) {
        scratch_units[push.point_units + index + i] =
            uvec4(batch.direction[i] | (i == 0u ? before << local_shift : 0u), edges[i],
                  batch.number[i], words[i]);
        if (finds_pairs) {
            scratch[push.depths + index + i] = floatBitsToUint(depths[i]);
        }
    }
}
