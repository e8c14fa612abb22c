#pragma once

#include <tools/rendering/drawing.hpp>
#include <tools/simulation/clearance_scene.hpp>

namespace nearfield::tools {

/// Adds the scale of the colours with a mark at the last frame's clearance, and what this frame
/// asked and found, at the lower edge of the page.
void draw_clearance_legend(Drawing& drawing, const simulation::ClearanceScene& scene,
                           const Rectangle& page);

}  // namespace nearfield::tools
