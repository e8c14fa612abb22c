#pragma once

#include <nearfield/shape.hpp>

#include <tools/drawing/canvas.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// A line of a chart; all x and y > 0.
struct ChartLine {
    std::string name;
    Color color;
    std::vector<Vector2> points;
};

/// A chart with two logarithmic axes.
struct LineChart {
    std::string title;
    std::string x_name;
    std::string y_name;
    std::vector<ChartLine> lines;
};

/// Draws a chart into a rectangle of the page. Precondition: at least one line has a point.
void draw_line_chart(Canvas& canvas, const LineChart& chart, const Rectangle& page);

}  // namespace nearfield::tools
