#pragma once

#include <nearfield/result.hpp>

#include <tools/drawing/canvas.hpp>
#include <tools/drawing/view.hpp>

namespace nearfield::tools {

/// Marks for the results of a query in the right panel.
void draw_penetrating_points(Canvas& canvas, const PenetrationResult& result, const View& view);
void draw_samples(Canvas& canvas, const IntersectionResult& result, const View& view);
void draw_contacts(Canvas& canvas, const ContactResult& result, const View& view);

/// Single marks of each kind, also used in the legend.
void draw_point_mark(Canvas& canvas, Vector2 point);
void draw_way_out(Canvas& canvas, Vector2 point, Vector2 nearest);
void draw_deepest_mark(Canvas& canvas, Vector2 point, Vector2 nearest);
void draw_contact_mark(Canvas& canvas, Vector2 point, Vector2 tip);
void draw_stretch_mark(Canvas& canvas, Vector2 first, Vector2 last);
void draw_closest_pair(Canvas& canvas, Vector2 on_a, Vector2 on_b);
void draw_sample_mark(Canvas& canvas, Vector2 center, double side);

}  // namespace nearfield::tools
