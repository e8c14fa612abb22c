#pragma once

#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <tools/drawing/canvas.hpp>
#include <tools/drawing/view.hpp>
#include <tools/io/answer.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// A shape of a figure, in world coordinates.
struct FigureShape {
    std::string name;
    std::vector<Ring> rings;
};

/// A shape of a figure at another time, in world coordinates.
struct FigureTrace {
    enum class Kind { start, on_the_way, end };
    std::vector<Ring> rings;
    Side of = Side::a;
    Kind kind = Kind::end;
};

/// The contents of a picture of one answer: both outlines in full on the left; on the right,
/// enlarged, what the query found, over the signed distance field of B if there is one.
struct Figure {
    const Answer& answer;
    FigureShape a;
    FigureShape b;
    const DistanceFieldResult* field = nullptr;  ///< of B; may cover more than the right panel
    std::vector<FigureTrace> traces = {};        ///< of moving shapes
};

/// The part of the world in the right panel. Precondition: both shapes have vertices.
[[nodiscard]] Rectangle detail_rectangle(const Answer& answer, const FigureShape& a,
                                         const FigureShape& b);

/// Draws a figure; returns the contents of a PNG file.
[[nodiscard]] std::string draw_figure(const Figure& figure);

/// Single marks of each kind, also used in the legend.
void draw_point_mark(Canvas& canvas, Vector2 point);
void draw_way_out(Canvas& canvas, Vector2 point, Vector2 nearest);
void draw_deepest_mark(Canvas& canvas, Vector2 point, Vector2 nearest);
void draw_contact_mark(Canvas& canvas, Vector2 point, Vector2 tip);
void draw_stretch_mark(Canvas& canvas, Vector2 first, Vector2 last);
void draw_closest_pair(Canvas& canvas, Vector2 on_a, Vector2 on_b);
void draw_sample_mark(Canvas& canvas, Vector2 center, double side);

}  // namespace nearfield::tools
