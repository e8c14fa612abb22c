#pragma once

#include <nearfield/shape.hpp>

#include <tools/picture/canvas.hpp>
#include <tools/picture/field_layer.hpp>
#include <tools/picture/view.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A number with the decimals that a step of a scale needs, with a true minus sign.
[[nodiscard]] std::string scale_number(double number, double step);

/// The colours of a field with numbers to their right, over a strip of the page.
void draw_color_bar(Canvas& canvas, const FieldScale& scale, const Rectangle& strip);

/// A length in world units in the low left corner of a view.
void draw_scale_bar(Canvas& canvas, const View& view);

/// One line of a legend: a symbol, drawn into a small rectangle, and what it stands for.
struct LegendEntry {
    std::function<void(Canvas&, const Rectangle&)> symbol;
    std::string text;
};

/// Draws a legend downwards from the top of `area`; texts too long for it are cut.
void draw_legend(Canvas& canvas, const std::vector<LegendEntry>& entries, const Rectangle& area);

}  // namespace nearfield::tools
