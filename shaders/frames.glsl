// The frames of the two shapes of a direction (search.h).

// From A's frame to B's, with the ratio of their units.
mat2 rotation_of(SearchDirectionData direction) {
    return mat2(direction.axis.x, direction.axis.y, -direction.axis.y, direction.axis.x);
}

// A point of A's frame in B's.
vec2 placed(SearchDirectionData direction, vec2 point) {
    return rotation_of(direction) * point + direction.offset;
}
