#pragma once

#include <nearfield/shape.hpp>

#include <tools/drawing/canvas.hpp>
#include <tools/drawing/color.hpp>

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::tools {

/// The interior of rings by the odd-even rule, in one colour.
struct FilledRings {
    std::vector<Ring> rings;
    Color color;
};

/// A line of a given width with round corners and ends.
struct DrawnLine {
    std::vector<Vector2> points;
    bool closed = false;
    Color color;
    double width = 1.0;
};

struct DrawnDot {
    Vector2 center;
    double radius = 1.0;
    Color color;
};

/// A grid of colours over a rectangle, row by row from its `min`.
struct ColoredCells {
    Rectangle rectangle;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<Color> colors;
};

using DrawnItem = std::variant<FilledRings, DrawnLine, DrawnDot, ColoredCells>;

/// A list of coloured primitives in pixels of a page (x to the right, y down); later ones cover
/// earlier ones. Independent of the renderer.
class Drawing {
public:
    void fill(std::vector<Ring> rings, const Color& color);
    void line(std::vector<Vector2> points, const Color& color, double width, bool closed = false);
    void dot(Vector2 center, double radius, const Color& color);
    /// Adds a shaft and, if it is long enough, a filled head at `to`.
    void arrow(Vector2 from, Vector2 to, double head, const Color& color, double width);
    void cells(ColoredCells cells);
    /// Adds a line of text; its baseline starts, is centred or ends at `position`.
    void text(Vector2 position, const std::string& text, double size, const Color& color,
              Align align = Align::left);

    void clear() { items_.clear(); }
    [[nodiscard]] const std::vector<DrawnItem>& items() const { return items_; }

private:
    std::vector<DrawnItem> items_;
};

}  // namespace nearfield::tools
