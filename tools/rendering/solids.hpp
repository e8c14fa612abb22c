#pragma once

#include <tools/drawing/view.hpp>
#include <tools/rendering/drawing.hpp>
#include <tools/simulation/scene.hpp>

namespace nearfield::tools {

/// Adds the ground and the bodies of a scene as solids on it: convex outlines with a height, wheels
/// and a cabin, seen from the south and above. Ground positions are those of the flat picture, so
/// contacts and normals drawn over it fit.
void draw_solids(Drawing& drawing, const simulation::Scene& scene, const View& view);

}  // namespace nearfield::tools
