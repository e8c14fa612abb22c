#pragma once

#include <nearfield/result.hpp>

#include <tools/picture/canvas.hpp>
#include <tools/picture/color.hpp>
#include <tools/picture/view.hpp>

#include <cstddef>
#include <functional>

namespace nearfield::tools {

/// What a field covers of a view's page rectangle, in whole pixels.
[[nodiscard]] Rectangle covered_page(const DistanceFieldResult& field, const View& view);

/// Draws every cell of a field in a colour of its own. `color` takes the cell's place in the
/// result's arrays.
void draw_cells(Canvas& canvas, const DistanceFieldResult& field, const View& view,
                const std::function<Color(std::size_t)>& color);

/// The Voronoi diagram in false colour: every feature of B has its own, far from those of its
/// neighbours along the boundary; vertices are light, edges are strong.
void draw_voronoi(Canvas& canvas, const DistanceFieldResult& field, const View& view);
[[nodiscard]] Color feature_color(Feature feature);

/// The gradient: its direction as a hue, and arrows on a coarse grid.
void draw_gradient(Canvas& canvas, const DistanceFieldResult& field, const View& view);
[[nodiscard]] Color direction_color(Vector2 direction);
void draw_gradient_arrow(Canvas& canvas, Vector2 middle, Vector2 direction);

}  // namespace nearfield::tools
