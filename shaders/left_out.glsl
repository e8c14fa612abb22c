// Which points need not be kept where only their number and the deepest are asked for. Include after
// search.glsl and largest(), in a shader that has declared its local size.

// Points that are not farther from the boundary may be on either side.
float near_boundary_of(float margin) {
    return 2.0 * margin;
}

// Of the points of a workgroup that have the same direction; by how many directions it is after that
// of the first thread.
shared uint direction_of_first;
shared uint deepest_of[search_block];  // bits of a float that is not negative
shared uint left_out_of[search_block];
shared uint first_of[search_block];  // thread that keeps points

// Leaves out the points that are not needed to tell how many are deeper than a touch and which is the
// deepest: those that are not deeper for certain; and of those that are, the ones less deep than
// another of their direction in the workgroup. Returns how many of the latter the first point that
// the thread keeps stands for. Call from every thread of the workgroup.
uint leave_out(uint direction, vec4 depths, inout uvec4 words) {
    uint own = gl_LocalInvocationID.x;
    deepest_of[own] = 0u;
    left_out_of[own] = 0u;
    first_of[own] = search_block;
    if (own == 0u) {
        direction_of_first = direction;
    }
    barrier();
    // Where the directions between have no points, a thread may be by itself.
    uint place = direction - direction_of_first;
    bool shares = place < search_block;
    float margin = uintBitsToFloat(direction_unit(direction, 2u).y);
    float touching = uintBitsToFloat(direction_unit(direction, 3u).y);
    float least_depth = max(touching + depth_margins * margin, near_boundary_of(margin));
    uvec4 deeper = uvec4(notEqual(words, uvec4(0u))) & uvec4(greaterThan(depths, vec4(least_depth)));
    float deepest = largest(mix(vec4(0.0), depths, bvec4(deeper)));
    if (shares && deepest > 0.0) {
        atomicMax(deepest_of[place], floatBitsToUint(deepest));
    }
    barrier();
    uint left_out = 0u;
    if (touching >= 0.0) {
        deepest = shares ? uintBitsToFloat(deepest_of[place]) : deepest;
        uvec4 less_deep =
            deeper & uvec4(lessThan(depths, vec4(deepest - 2.0 * depth_margins * margin)));
        uvec4 not_deeper = uvec4(greaterThanEqual(depths, vec4(0.0))) &
                           uvec4(lessThan(depths, vec4(touching - depth_margins * margin)));
        words = mix(words, uvec4(0u), bvec4(less_deep | not_deeper));
        left_out = less_deep.x + less_deep.y + less_deep.z + less_deep.w;
        if (shares && left_out > 0u) {
            atomicAdd(left_out_of[place], left_out);
        }
        if (shares && words != uvec4(0u)) {
            atomicMin(first_of[place], own);
        }
    }
    barrier();
    return !shares ? left_out : first_of[place] == own ? left_out_of[place] : 0u;
}
