// The details of a resolved point, written in addition to its word if records are resident. Include
// after nearest.glsl; the shader declares results[] and push.details.

// Offset, in cells, at which the two sides of an edge are tested.
const float step_aside = 1.0 / 4096.0;

// The outward normal of the nearest edge; zero if there is none or it has no length. Beside a vertex
// another edge may be in between: sides are tested a part of a cell away from it.
vec2 normal_of_wall(Nearest nearest, OnEdge place, EdgeListData crossing) {
    float size = length(place.way);
    if (!(size > 0.0)) {
        return vec2(0.0);
    }
    vec2 along = place.way / size;
    float step_along = min(0.25, 0.5 * size);
    float shift = place.along * size < step_along
                      ? step_along
                      : ((1.0 - place.along) * size < step_along ? -step_along : 0.0);
    vec2 normal = vec2(-along.y, along.x);
    vec2 beside = nearest.point + shift * along + step_aside * normal;
    return inside_by_crossings(beside, crossing) ? -normal : normal;
}

void write_details(uint index, vec2 p, Nearest nearest, TileData tile) {
    if (push.details == not_asked) {
        return;
    }
    vec2 offset = nearest.point - p;
    // At a distance this small the direction of the offset is meaningless.
    bool touches = nearest.distance <= 2.0 * touching;
    OnEdge place = on_edge(p, tile.nearest, nearest);
    vec2 normal = touches ? normal_of_wall(nearest, place, tile.crossing) : vec2(0.0);
    uint word = push.details + words_of_details * index;
    results[word] = floatBitsToUint(offset.x);
    results[word + 1u] = floatBitsToUint(offset.y);
    results[word + 2u] = floatBitsToUint(place.along);
    results[word + 3u] = packSnorm2x16(normal);
}
