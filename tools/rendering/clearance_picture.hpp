#pragma once

#include <tools/drawing/view.hpp>
#include <tools/rendering/drawing.hpp>
#include <tools/simulation/clearance_scene.hpp>

namespace nearfield::tools {

/// Adds a scene of clearances: its obstacles, the paths and the shape that moves, coloured by their
/// least clearances, the two nearest points, and below them the scale of the colours.
void draw_clearances(Drawing& drawing, const simulation::ClearanceScene& scene, const View& view);

}  // namespace nearfield::tools
