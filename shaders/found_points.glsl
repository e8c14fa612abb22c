// The points that a search has looked at, in the order of directions, and those of them that it has
// found. Include after search.glsl.

// The first place of the points of a direction, or of those after it.
uint first_point(uint direction) {
    uint points = scratch[point_total];
    uint edges = scratch[edge_total];
    uint edge = direction < direction_count() ? edges_before(direction_unit(direction, 1u).w) : edges;
    return edge < edges ? min(place_of(edge), points) : points;
}

// How many were found before a point.
uint found_before(uint point) {
    uint found = scratch[record_total];
    if (point >= scratch[point_total]) {
        return found;
    }
    uint block = point / (points_per_thread * search_block);
    return min(found, scratch_word(push.point_blocks + block) +
                          (scratch_unit(push.point_units + point).x >> local_shift));
}

// Whether there was room for all that the search has counted.
bool had_room() {
    bool fits = true;
    for (uint stage = 0u; stage < row_total; ++stage) {
        fits = fits && scratch[first_counted + stage] <= scratch[stage];
    }
    return fits;
}

// The depths of four points, of which the first has a number that four divides.
vec4 four_depths(uint four) {
    return uintBitsToFloat(scratch_unit(push.depths / 4u + four));
}
