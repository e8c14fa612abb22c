#pragma once

#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <tools/output/answer.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// A shape of a figure, in world coordinates.
struct FigureShape {
    std::string name;
    std::vector<Ring> rings;
};

/// A shape of a figure where it is at another time, in world coordinates.
struct FigureTrace {
    enum class Kind { start, on_the_way, end };
    std::vector<Ring> rings;
    Side of = Side::a;
    Kind kind = Kind::end;
};

/// What a picture of one answer shows: both outlines whole on the left; on the right, larger, what
/// the query found, over the signed distance field of B where there is one.
struct Figure {
    const Answer& answer;
    FigureShape a;
    FigureShape b;
    const DistanceFieldResult* field = nullptr;  ///< of B; may cover more than the right panel
    std::vector<FigureTrace> traces = {};        ///< of what moves
};

/// The part of the world that the right panel shows; precondition: both shapes have vertices.
[[nodiscard]] Rectangle detail_rectangle(const Answer& answer, const FigureShape& a,
                                         const FigureShape& b);

/// Draws a figure; returns the bytes of a PNG file.
[[nodiscard]] std::string draw_figure(const Figure& figure);

}  // namespace nearfield::tools
