// How a direction becomes one of those that are searched. Include after search.glsl.

// `items`: how many it has, the first of which it names; `room`: for how many of all there is room.
void write_direction(uint index, SearchDirectionData data, uint items, uint room) {
    uint unit = push.directions + units_of_direction * index;
    scratch_units[unit] = floatBitsToUint(vec4(data.axis, data.offset));
    scratch_units[unit + 1u] = uvec4(data.shape_a, data.shape_b, data.parts, data.first_item);
    scratch_units[unit + 2u] =
        floatBitsToUint(vec4(data.reach, data.margin, data.rival, data.outside));
    scratch_units[unit + 3u] =
        uvec4(floatBitsToUint(data.doubt), floatBitsToUint(data.touching), data.a, data.b);
    // Of each block of items that starts among these, its first direction.
    uint end = min(data.first_item + items, room);
    for (uint block = (data.first_item + search_block - 1u) / search_block;
         search_block * block < end; ++block) {
        scratch[push.first_directions + block] = index;
    }
}
