#version 450
#extension GL_GOOGLE_include_directive : require

// What stays on the device of the pairs of a world: the frame of B in the world, one thread per
// direction. The search no longer needs the memory of its ranges.

#include "search.glsl"
#include "pairs.glsl"

layout(local_size_x = group_size) in;

void main() {
    uint direction = dispatched_index();
    if (direction >= scratch[pair_total]) {
        return;
    }
    SearchInstanceData b = instance_at(direction_unit(direction, 3u).w);
    scratch_units[push.range_units + direction] =
        floatBitsToUint(vec4(b.unit * b.axis, b.high + b.low));
}
