#version 450
#extension GL_GOOGLE_include_directive : require

// The vertex shader of meshes that reach no other tile (geometry::MeshVertex).

#include "mesh.glsl"

void main() {
    place_vertex();
}
