#version 450
#extension GL_GOOGLE_include_directive : require

// The search's fifth step, one thread per four points of A's boundary, which share the edges that it
// loads: the side of B's boundary on which a point lies where that is not known, the nearest edge
// of B, and what single precision leaves in doubt.

#include "search.glsl"

layout(local_size_x = group_size) in;

#include "sums.glsl"
#include "totals.glsl"
#include "scan.glsl"
#include "four_points.glsl"
#include "nearest_edges.glsl"

// Points that are not farther from the boundary may be on either side.
float near_boundary_of(float margin) {
    return 2.0 * margin;
}

// Returns the words of four points; 0 for those that are not asked for. `depth`: the distance from
// the boundary; 0 outside, unless points there are asked for; negative where a walk takes too long.
uvec4 resolve(Points p, bvec4 asked, SearchDirectionData direction, out vec4 depth) {
    Shape b = shape_at(direction.shape_b);
    bool too_long = false;
    bvec4 inside = find_inside(p, asked, b, too_long);
    float near_boundary = near_boundary_of(direction.margin);
    vec4 limit = direction.outside != 0.0 ? vec4(direction.reach + near_boundary)
                                   : mix(vec4(near_boundary), vec4(infinity), inside);
    float more = max(direction.rival, direction.doubt);
    Nearest nearest = find_nearest(p, b, limit, more, too_long);
    uvec4 found = uvec4(notEqual(nearest.slot, uvec4(no_parts)));
    uvec4 edge;
    for (int i = 0; i < 4; ++i) {
        edge[i] = found[i] != 0u ? number_of(b, nearest.slot[i]) : 0u;
    }
    Rivals rivals = Rivals(bvec4(false), bvec4(false));
    if (found != uvec4(0u)) {
        rivals = find_rivals(p, b, nearest, edge, direction, more, too_long);
    }
    bvec4 has_depth = bvec4(uvec4(inside) | uvec4(direction.outside != 0.0));
    depth = too_long ? vec4(-1.0) : mix(vec4(0.0), sqrt(nearest.squared), has_depth);
    if (too_long) {
        return point_resolved | point_doubtful | edge;
    }
    uvec4 doubtful = uvec4(rivals.doubtful) |
                     uvec4(lessThanEqual(nearest.squared, vec4(near_boundary * near_boundary)));
    return found * (point_resolved | uvec4(inside) * point_inside |
                    uvec4(not(rivals.exist)) * point_unique | doubtful * point_doubtful | edge);
}

// The points of one thread, which have the same direction.
struct Batch {
    uint direction;
    uint count;
    uvec4 slot;    // of edges of A
    uvec4 number;  // among the points of the edge
    bvec4 asked;
};

// Fills a batch with points of the edges from `edge` to `end - 1` that have its direction. `skipped`:
// the points of the first one that come before.
void fill(inout Batch batch, uint edge, uint end, uint skipped) {
    for (; batch.count < points_per_thread && edge < end; ++edge) {
        uint unit = push.edge_units + units_of_edge * edge;
        uvec4 about = scratch_unit(unit);
        uvec4 asked = scratch_unit(unit + 1u);
        if (about.x != batch.direction) {
            break;
        }
        uvec4 place = uvec4(0u, 1u, 2u, 3u) - batch.count;  // large before it
        uvec4 number = about.z + skipped + place;
        bvec4 is_own = lessThan(place, uvec4(asked.z - skipped));
        batch.slot = mix(batch.slot, uvec4(about.y), is_own);
        batch.number = mix(batch.number, number, is_own);
        batch.asked = bvec4(mix(uvec4(batch.asked),
                                uvec4(greaterThanEqual(number, asked.xxxx)) &
                                    uvec4(lessThan(number, asked.yyyy)),
                                is_own));
        batch.count += asked.z - skipped;
        skipped = 0u;
    }
    batch.count = min(batch.count, points_per_thread);
}

// The points from a place on, which the edges of one block have.
Batch batch_at(uint index) {
    uint edges = scratch[edge_total];
    uint blocks = (edges + search_block - 1u) / search_block;
    uint block = last_at_most(index, push.edge_blocks, blocks, 1u);
    uint first = search_block * block;
    uint end = min(first + search_block, edges);
    uint rest = index - scratch_word(push.edge_blocks + block);
    uint words = 4u * (push.edge_units + units_of_edge * first) + 3u;
    uint edge = first + last_at_most(rest, words, end - first, 4u * units_of_edge);
    uvec4 about = scratch_unit(push.edge_units + units_of_edge * edge);
    Batch batch = Batch(about.x, 0u, uvec4(0u), uvec4(0u), bvec4(false));
    fill(batch, edge, end, rest - about.w);
    return batch;
}

// Returns the words of the points. Those beyond the count are repetitions of the first one.
uvec4 resolve_batch(Batch batch, out uvec4 edges, out vec4 depths) {
    SearchDirectionData direction = direction_at(batch.direction);
    Shape a = shape_at(direction.shape_a);
    bvec4 exist = lessThan(uvec4(0u, 1u, 2u, 3u), uvec4(batch.count));
    uvec4 slot = mix(batch.slot.xxxx, batch.slot, exist);
    uvec4 number = mix(batch.number.xxxx, batch.number, exist);
    vec4 x, y;
    for (uint i = 0u; i < points_per_thread; ++i) {
        vec4 edge = floats_at(a.edges + slot[i]);
        edges[i] = number_of(a, slot[i]);
        float along = float(number[i]) / float(parts_of(direction, edges[i]));
        vec2 from = placed(direction, edge.xy);
        vec2 end = placed(direction, edge.zw);
        vec2 p = from + along * (end - from);
        x[i] = p.x;
        y[i] = p.y;
    }
    uvec4 words = resolve(points_at(x, y), batch.asked, direction, depths);
    return mix(uvec4(0u), words, exist);
}

void main() {
    uint thread = dispatched_index();
    uint index = points_per_thread * thread;
    uint total = scratch[point_total];
    uvec4 edges = uvec4(0u);
    uvec4 words = uvec4(0u);
    vec4 depths = vec4(0.0);
    Batch batch = Batch(0u, 0u, uvec4(0u), uvec4(0u), bvec4(false));
    if (index < total) {
        batch = batch_at(index);
        words = resolve_batch(batch, edges, depths);
    }
    uvec4 found = uvec4(notEqual(words, uvec4(0u)));
    uint before = sum_before(found.x + found.y + found.z + found.w,
                             push.block_sums + thread / search_block);
    for (uint i = 0u; i < points_per_thread && index + i < total; ++i) {
        scratch_units[push.point_units + index + i] =
            uvec4(batch.direction | before << local_shift, edges[i], batch.number[i], words[i]);
        scratch[push.depths + index + i] =
            floatBitsToUint(found[i] != 0u ? depths[i] : nothing_found);
        before += found[i];
    }
    if (push.stage == record_total) {  // where anybody asks for numbers of points
        scan(push.point_blocks, threads_for(total));
    }
}
