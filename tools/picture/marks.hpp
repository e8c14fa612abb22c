#pragma once

#include <nearfield/result.hpp>

#include <tools/picture/canvas.hpp>
#include <tools/picture/view.hpp>

namespace nearfield::tools {

/// What a query found, as marks in the right panel.
void draw_penetrating_points(Canvas& canvas, const PenetrationResult& result, const View& view);
void draw_samples(Canvas& canvas, const IntersectionResult& result, const View& view);

/// One mark of each kind, as the legend shows it too.
void draw_point_mark(Canvas& canvas, Vector2 point);
void draw_way_out(Canvas& canvas, Vector2 point, Vector2 nearest);
void draw_deepest_mark(Canvas& canvas, Vector2 point, Vector2 nearest);
void draw_sample_mark(Canvas& canvas, Vector2 center, double side);

}  // namespace nearfield::tools
