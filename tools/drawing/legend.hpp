#pragma once

#include <nearfield/shape.hpp>

#include <tools/drawing/canvas.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/drawing/view.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// Formats a number with as many decimals as the step of a scale needs, and with a true minus sign.
[[nodiscard]] std::string scale_number(double number, double step);

/// Draws the colours of a field with numbers to their right, over a strip of the page.
void draw_color_bar(Canvas& canvas, const FieldScale& scale, const Rectangle& strip);

/// Draws the length of a world distance in the lower left corner of a view.
void draw_scale_bar(Canvas& canvas, const View& view);

/// One line of a legend: a symbol, drawn into a small rectangle, and its meaning.
struct LegendEntry {
    std::function<void(Canvas&, const Rectangle&)> symbol;
    std::string text;
};

/// Draws a legend downwards from the top of `area`; texts that are too long are truncated.
void draw_legend(Canvas& canvas, const std::vector<LegendEntry>& entries, const Rectangle& area);

/// The legend entries of a figure; `field` is null if no field is drawn.
[[nodiscard]] std::vector<LegendEntry> legend_of(const Figure& figure, const FieldScale* field);

}  // namespace nearfield::tools
