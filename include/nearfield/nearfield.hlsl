// Outputs on the device of nearfield, for HLSL shaders to read (compiled to SPIR-V): the same structures as
// in nearfield.glsl, which describes them in full.
//
// Declare buffers as StructuredBuffer or ByteAddressBuffer at the offset that on_device.hpp states: a
// summary, followed by points or samples.
#ifndef NEARFIELD_HLSL
#define NEARFIELD_HLSL

// A feature id, in a texel of the feature image and of a point.
static const uint nearfield_index_mask = 0x0fffffffu;  // index of the edge or vertex
static const uint nearfield_vertex_flag = 1u << 28;    // a vertex; otherwise an edge
static const uint nearfield_unique_flag = 1u << 30;    // no other part of the boundary is as near
static const uint nearfield_inside_flag = 1u << 31;    // the point lies inside the shape

// NearfieldPoint::flags
static const uint nearfield_on_b_flag = 1u;       // of a batch: on B's boundary; otherwise on A's
static const uint nearfield_touching_flag = 2u;   // too near to tell inside from outside
static const uint nearfield_undecided_flag = 4u;  // something else may be as near; also of a pair

static const uint nearfield_no_point = 0xffffffffu;
static const uint nearfield_no_edge = 0xffffffffu;

struct NearfieldHeader {
    uint4 points;    // VkDrawIndirectCommand
    uint4 quads;     // VkDrawIndirectCommand
    uint groups[3];  // VkDispatchIndirectCommand
    uint count;
    float2 origin;
    float cell;
    uint overflow;
    uint width;
    uint height;
};

struct NearfieldSummary {
    uint count;
    uint capacity;
    uint deepest;  // nearfield_no_point if there is none
    float depth;
};

struct NearfieldPoint {
    float2 position;
    float2 nearest;
    float2 normal;
    float distance;
    uint feature;
    uint edge;
    uint flags;
};

struct NearfieldIntersectionSummary {
    uint count;
    uint capacity;
    float area;
    float cell;
    float2 low;
    float2 high;
};

struct NearfieldIntersectionSample {
    float2 position;
    uint edge;        // nearfield_no_edge if A takes part by its volume
    uint region;
};

// NearfieldPair::flags; with nearfield_undecided_flag it is open whether it is hit
static const uint nearfield_uncertain_flag = 8u;    // count and deepest point are not certain
static const uint nearfield_intersects_flag = 16u;  // contacts: the shapes intersect for certain

struct NearfieldPair {
    uint a;
    uint b;
    uint count;
    uint flags;
    uint first_point;
    uint point_count;
    uint first_of_b;
    uint count_of_b;
    uint deepest;  // nearfield_no_point if there is none
    float depth;
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
float2 nearfield_texel(float2 place, float2 origin, float cell) {
    return (place - origin) / cell;
}

// The signed distance at a position in texels: bilinear between the four cells around it; clamped
// at the rim. Loads, since a device need not support filtering of this format.
float nearfield_signed_distance(Texture2D<float> field, int2 size, float2 texel) {
    int2 low = int2(floor(texel - 0.5));
    int2 first = clamp(low, 0, size - 1);
    int2 last = clamp(low + 1, 0, size - 1);
    float2 way = frac(texel - 0.5);
    float below = lerp(field.Load(int3(first, 0)), field.Load(int3(last.x, first.y, 0)), way.x);
    float above = lerp(field.Load(int3(first.x, last.y, 0)), field.Load(int3(last, 0)), way.x);
    return lerp(below, above, way.y);
}

#endif  // __cplusplus

#endif
