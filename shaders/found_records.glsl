// The points that a search between pairs has found. Include after search.glsl.

#include "pairs.h"

layout(std430, set = 0, binding = 2) readonly buffer Records {
    uvec4 records[];
};

// The first record of a direction, or of those after it.
uint first_record(uint direction) {
    uint first = 0u;
    uint count = scratch[record_total];
    while (count > 0u) {
        uint half_count = count / 2u;
        if (records[first + half_count].x < direction) {
            first += half_count + 1u;
            count -= half_count + 1u;
        } else {
            count = half_count;
        }
    }
    return first;
}
