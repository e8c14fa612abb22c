// Shared by the export passes (resident outputs): the words written by the resolve passes, the
// tables written by the host, and feature ids.

#include "export.h"
#include "nearfield/nearfield.glsl"
#include "push.h"

layout(std430, set = 0, binding = 0) readonly buffer Words {
    uint words[];
};
layout(std430, set = 0, binding = 1) readonly buffer Tables {
    uint tables[];
};

// The vertex after an edge. `rings`: position in the tables of the first edge of every ring,
// followed by the number of all edges.
uint next_vertex(uint edge, uint rings, uint ring_count) {
    uint low = 0u;
    uint high = ring_count;  // the ring of the edge is one of low to high - 1
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (tables[rings + middle] <= edge) {
            low = middle;
        } else {
            high = middle;
        }
    }
    uint next = edge + 1u;
    return next == tables[rings + low + 1u] ? tables[rings + low] : next;
}
