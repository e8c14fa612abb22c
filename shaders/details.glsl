// What of a resolved point stays on the device beside its word, where that is asked for: the
// details of plan::PointDetails. Stands after nearest.glsl; the shader has declared results[] and
// push.details.

const uint no_details = 0xffffffffu;
const uint words_of_details = 4u;

// Nearer to the boundary than this, in cells, single precision cannot tell on which side of it a
// point lies (engine/nearest_feature.hpp, of tiles of points).
const float touching = 1.0 / 32768.0;
// So far to its side, an edge's own sides are told apart.
const float step_aside = 1.0 / 4096.0;

// The normal of the nearest edge that points outside; where nothing is nearest, or an edge of no
// length, zero.
vec2 normal_of_wall(Nearest nearest, EdgeList crossing) {
    float size = length(nearest.way);
    if (!(size > 0.0)) {
        return vec2(0.0);
    }
    vec2 normal = vec2(-nearest.way.y, nearest.way.x) / size;
    return inside_by_crossings(nearest.point + step_aside * normal, crossing) ? -normal : normal;
}

void write_details(uint index, vec2 p, Nearest nearest, EdgeList crossing) {
    if (push.details == no_details) {
        return;
    }
    vec2 offset = nearest.point - p;
    // The distance decides whether the offset's direction means anything.
    bool touches = nearest.distance <= 2.0 * touching;
    vec2 normal = touches ? normal_of_wall(nearest, crossing) : vec2(0.0);
    uint word = push.details + words_of_details * index;
    results[word] = floatBitsToUint(offset.x);
    results[word + 1u] = floatBitsToUint(offset.y);
    results[word + 2u] = floatBitsToUint(nearest.along);
    results[word + 3u] = packSnorm2x16(normal);
}
