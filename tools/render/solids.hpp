#pragma once

#include <tools/dynamics/scene.hpp>
#include <tools/picture/view.hpp>
#include <tools/render/drawing.hpp>

namespace nearfield::tools {

/// Adds the ground and the bodies of a scene as solids on it: convex outlines with a height, wheels
/// and a cabin, seen from the south and above. What stands on the ground is where the flat picture
/// has it, so contacts and normals drawn over it fit.
void draw_solids(Drawing& drawing, const dynamics::Scene& scene, const View& view);

}  // namespace nearfield::tools
