// What the vertex shaders of meshes share: pixels of the atlas to the viewport, and distance to
// depth.

#include "push.h"

layout(push_constant) uniform Push { MeshPush push; };

layout(location = 0) in vec2 position;
layout(location = 1) in float distance_to_feature;
layout(location = 2) in uint id;

// The id of the feature, or the draw's own value if ids are 0.
layout(location = 0) flat out uint number;

void place_vertex() {
    gl_Position = vec4(position * push.scale + push.bias, distance_to_feature * push.depth_scale, 1.0);
    number = id | push.value;
}
