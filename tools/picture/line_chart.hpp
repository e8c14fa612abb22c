#pragma once

#include <nearfield/shape.hpp>

#include <tools/picture/canvas.hpp>
#include <tools/picture/color.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// A line of a chart through points, x and y > 0.
struct ChartLine {
    std::string name;
    Color color;
    std::vector<Vector2> points;
};

/// Both axes are logarithmic.
struct LineChart {
    std::string title;
    std::string x_name;
    std::string y_name;
    std::vector<ChartLine> lines;
};

/// Draws a chart into a rectangle of the page. Precondition: a line has a point.
void draw_line_chart(Canvas& canvas, const LineChart& chart, const Rectangle& page);

}  // namespace nearfield::tools
