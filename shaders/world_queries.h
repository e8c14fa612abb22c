// Segments and points that ask about a world's instances (pairs.h), for shaders and for C++ (see
// shared.h). Positions are relative to the same origin, in world units. The device names what may
// be the answer, and the CPU computes it.
#ifndef NEARFIELD_SHADERS_WORLD_QUERIES_H
#define NEARFIELD_SHADERS_WORLD_QUERIES_H

#include "pairs.h"

NEARFIELD_SHARED_BEGIN

// A segment.
struct RayData {
    vec2 from;  // rounded
    vec2 to;
    vec2 from_low;  // what the rounding has left out
    vec2 to_low;
};
const uint units_of_ray = 2u;
NEARFIELD_CHECK(sizeof(RayData) == 16 * units_of_ray)

// The edges among which the first hit of a segment is, if it hits anything.
const uint ray_candidates = 4u;
struct RayAnswerData {
    uint instances[ray_candidates];  // their numbers; no_instance: no candidate
    uint edges[ray_candidates];
};
const uint units_of_ray_answer = 2u;
NEARFIELD_CHECK(sizeof(RayAnswerData) == 16 * units_of_ray_answer)

// A point whose nearest instance is asked for.
struct NearestData {
    vec2 at;   // rounded
    vec2 low;  // what the rounding has left out
};
const uint units_of_nearest = 1u;
NEARFIELD_CHECK(sizeof(NearestData) == 16 * units_of_nearest)

// That instance, and the edges among which its nearest one is.
const uint nearest_candidates = 3u;
struct NearestAnswerData {
    uint instance;  // its number, and point_in_instance; no_instance: none is near enough
    uint edges[nearest_candidates];  // no_edge: no candidate
};
const uint units_of_nearest_answer = 1u;
NEARFIELD_CHECK(sizeof(NearestAnswerData) == 16 * units_of_nearest_answer)
const uint point_in_instance = 1u << 31;
const uint no_edge = 0xffffffffu;

// A pose of the shape that is tested, as SearchInstanceData has it.
struct PoseData {
    vec2 axis;
    vec2 high;
    vec2 low;
    float rounding NEARFIELD_DEFAULT(0.0F);
    uint unused NEARFIELD_DEFAULT(0);
};
const uint units_of_pose = 2u;
NEARFIELD_CHECK(sizeof(PoseData) == 16 * units_of_pose)
// The answer is a word: 1 if the shape meets an instance, 0 if it meets none, or answered_by_cpu.
// A step of its walk compares all edges of two chunks: see max_query_steps.
const uint max_pose_steps = 750u;

// In place of the first instance: single precision cannot tell, or the walk is too long.
const uint answered_by_cpu = 0xfffffffeu;

// One walk takes so many steps, each of which is up to 17 turns of loops: the loops of neighbouring
// threads run in step (see max_instance_steps).
const uint max_query_steps = 3000u;
// Bound on the errors of single precision for what comes near an instance, in units of its shape's
// frame: with a larger one, hardly any edge could be told from another.
NEARFIELD_FLOAT max_query_margin = 1.0 / 16.0;

NEARFIELD_SHARED_END

#endif
