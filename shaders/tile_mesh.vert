#version 450
#extension GL_GOOGLE_include_directive : require

// The vertex shader of meshes that carry the rectangle of their tile (raster::TileVertex).

#include "mesh.glsl"

layout(location = 3) in uvec4 tile;

layout(location = 1) flat out uvec4 tile_rectangle;

void main() {
    place_vertex();
    tile_rectangle = tile;
}
