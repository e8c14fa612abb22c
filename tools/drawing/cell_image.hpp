#pragma once

#include <nearfield/result.hpp>

#include <tools/drawing/canvas.hpp>
#include <tools/drawing/color.hpp>
#include <tools/drawing/view.hpp>

#include <cstddef>
#include <functional>

namespace nearfield::tools {

/// The part of a view's page rectangle that a field covers, in whole pixels.
[[nodiscard]] Rectangle covered_page(const DistanceFieldResult& field, const View& view);

/// Draws every cell of a field in its own colour. `color` takes the index of the cell in the
/// result's arrays.
void draw_cells(Canvas& canvas, const DistanceFieldResult& field, const View& view,
                const std::function<Color(std::size_t)>& color);

/// Draws the Voronoi diagram in false colour: every feature of B has a colour far from those of its
/// neighbours along the boundary; vertices are light, edges saturated.
void draw_voronoi(Canvas& canvas, const DistanceFieldResult& field, const View& view);
[[nodiscard]] Color feature_color(Feature feature);

/// Draws the gradient: its direction as a hue, with arrows on a coarse grid.
void draw_gradient(Canvas& canvas, const DistanceFieldResult& field, const View& view);
[[nodiscard]] Color direction_color(Vector2 direction);
void draw_gradient_arrow(Canvas& canvas, Vector2 middle, Vector2 direction);

}  // namespace nearfield::tools
