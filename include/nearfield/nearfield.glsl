// Outputs on the device of nearfield, for shaders to read: include this file in GLSL 4.50 for Vulkan.
// on_device.hpp declares the same structures in C++ and states how they are obtained;
// docs/resident_results.md describes them in full.
//
// Every name that might clash with the host's begins with nearfield_ or Nearfield.
#ifndef NEARFIELD_GLSL
#define NEARFIELD_GLSL

// A feature id, in a texel of the feature image and of a point: the nearest part of a boundary
// (Feature in result.hpp) and flags.
const uint nearfield_index_mask = 0x0fffffffu;   // index of the edge or vertex
const uint nearfield_vertex_flag = 1u << 28;     // a vertex; otherwise an edge
const uint nearfield_unique_flag = 1u << 30;     // no other part of the boundary is as near
const uint nearfield_inside_flag = 1u << 31;     // the point lies inside the shape

// NearfieldPoint::flags
const uint nearfield_on_b_flag = 1u;        // of a batch: on B's boundary; otherwise on A's
const uint nearfield_touching_flag = 2u;    // too near the boundary to tell inside from outside
const uint nearfield_undecided_flag = 4u;   // something else may be as near; also of a NearfieldPair

const uint nearfield_no_point = 0xffffffffu;

// What there is of an output on the device, and arguments that draw or dispatch as much (HeaderOnDevice in
// on_device.hpp). Of a field: its cells.
struct NearfieldHeader {
    uvec4 points;    // VkDrawIndirectCommand: one vertex for each point, sample or cell
    uvec4 quads;     // VkDrawIndirectCommand: six vertices and one instance for each; a field: one
    uint groups[3];  // VkDispatchIndirectCommand: 64 threads, one for each; a field: 8 x 8
    uint count;      // stored points, samples or cells
    vec2 origin;     // of the positions, or the low corner of a field's first cell
    float cell;      // side of a cell
    uint overflow;   // 1: more were found than there is space for; otherwise 0
    uint width;      // of a field, in cells; otherwise 0
    uint height;
};

struct NearfieldSummary {
    uint count;     // number of points that were found; more than the capacity are not stored
    uint capacity;  // reserved number of points; 0 if the search itself had no room
    uint deepest;   // the point of the greatest depth, stored or not; or nearfield_no_point
    float depth;    // its depth: distance to the boundary inside, negative outside
};

// Of a query of a batch, behind a NearfieldSummary; or of the pairs of a world.
struct NearfieldPoint {
    vec2 position;   // on the boundary of the one shape; relative to the origin
    vec2 nearest;    // nearest point of the other shape's boundary; relative to the origin
    vec2 normal;     // unit: out of the other shape; with nearfield_touching_flag that of the edge
    float distance;  // from `position` to `nearest`
    uint feature;    // id of the edge that `nearest` lies on
    uint edge;       // that `position` lies on
    uint flags;
};

const uint nearfield_no_edge = 0xffffffffu;

// The outputs of an intersection: the summary, followed by its samples.
struct NearfieldIntersectionSummary {
    uint count;     // number of samples found
    uint capacity;  // reserved number: 0 if samples were omitted, else never less than count
    float area;     // area of the cells found
    float cell;     // side of a cell
    vec2 low;       // the smallest box that holds all samples, if any; relative to
    vec2 high;      // the origin
};

struct NearfieldIntersectionSample {
    vec2 position;  // the centre of a cell, relative to the origin
    uint edge;    // of A, nearby; nearfield_no_edge if A takes part by its volume
    uint region;  // the region that the cell belongs to
};

// NearfieldPair::flags; with nearfield_undecided_flag it is open whether the pair is hit
const uint nearfield_uncertain_flag = 8u;    // it is, but count and deepest point are not certain
const uint nearfield_intersects_flag = 16u;  // contacts: the shapes intersect for certain

// A pair of instances that is hit, or may be (PairsOnDevice in pairs_on_device.hpp).
struct NearfieldPair {
    uint a;             // indices of the instances' handles
    uint b;
    uint count;         // of the points, those that count for certain
    uint flags;
    uint first_point;  // consecutive points, of A's boundary
    uint point_count;
    uint first_of_b;    // contacts: those of points of B's boundary
    uint count_of_b;
    uint deepest;       // penetrations: the point of the greatest depth, or nearfield_no_point
    float depth;        // its depth
};

#ifndef __cplusplus  // the declarations above are C++, too

uint nearfield_index(uint feature) {
    return feature & nearfield_index_mask;
}
bool nearfield_is_vertex(uint feature) {
    return (feature & nearfield_vertex_flag) != 0u;
}
bool nearfield_is_unique(uint feature) {
    return (feature & nearfield_unique_flag) != 0u;
}
bool nearfield_is_inside(uint feature) {
    return (feature & nearfield_inside_flag) != 0u;
}

// Depth of a point: its distance inside the other shape, negative outside.
float nearfield_depth(NearfieldPoint found) {
    return nearfield_is_inside(found.feature) ? found.distance : -found.distance;
}

// Position in a field's images, in texels: texel centres are at halves. `place` and `origin` in the
// same frame.
vec2 nearfield_texel(vec2 place, vec2 origin, float cell) {
    return (place - origin) / cell;
}

// The columns and rows of the four cells around a position in texels (first.x, first.y, last.x,
// last.y), clamped at the rim.
ivec4 nearfield_cells_around(ivec2 size, vec2 texel) {
    ivec2 low = ivec2(floor(texel - 0.5));
    return ivec4(clamp(low, ivec2(0), size - 1), clamp(low + 1, ivec2(0), size - 1));
}

// Bilinear between their values: lower left, lower right, upper left, upper right.
float nearfield_between(vec4 values, vec2 texel) {
    vec2 way = fract(texel - 0.5);
    return mix(mix(values.x, values.y, way.x), mix(values.z, values.w, way.x), way.y);
}

// The signed distance at a position in texels: bilinear between the four cells around it; clamped
// at the rim. Uses fetches, since a device need not support filtering of this format.
float nearfield_signed_distance(sampler2D field, ivec2 size, vec2 texel) {
    ivec4 at = nearfield_cells_around(size, texel);
    return nearfield_between(
        vec4(texelFetch(field, at.xy, 0).x, texelFetch(field, at.zy, 0).x,
             texelFetch(field, at.xw, 0).x, texelFetch(field, at.zw, 0).x), texel);
}

// The same for engines that bind textures and samplers apart. `with` may be any sampler: fetches do
// not filter.
float nearfield_signed_distance(texture2D field, sampler with, ivec2 size, vec2 texel) {
    ivec4 at = nearfield_cells_around(size, texel);
    return nearfield_between(vec4(texelFetch(sampler2D(field, with), at.xy, 0).x,
                                  texelFetch(sampler2D(field, with), at.zy, 0).x,
                                  texelFetch(sampler2D(field, with), at.xw, 0).x,
                                  texelFetch(sampler2D(field, with), at.zw, 0).x), texel);
}

#endif  // __cplusplus

#endif
