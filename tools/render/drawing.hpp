#pragma once

#include <nearfield/shape.hpp>

#include <tools/picture/color.hpp>

#include <cstddef>
#include <variant>
#include <vector>

namespace nearfield::tools {

/// The inside of rings by the odd-even rule, in one colour.
struct FilledRings {
    std::vector<Ring> rings;
    Color color;
};

/// A line of some width with round corners and ends.
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

/// A list of coloured things, the later ones over the earlier ones, in pixels of a page: x to the
/// right, y down. Knows nothing of what draws it.
class Drawing {
public:
    void fill(std::vector<Ring> rings, const Color& color);
    void line(std::vector<Vector2> points, const Color& color, double width, bool closed = false);
    void dot(Vector2 center, double radius, const Color& color);
    /// A shaft and, where it is long enough, a filled head at `to`.
    void arrow(Vector2 from, Vector2 to, double head, const Color& color, double width);
    void cells(ColoredCells cells);

    void clear() { items_.clear(); }
    [[nodiscard]] const std::vector<DrawnItem>& items() const { return items_; }

private:
    std::vector<DrawnItem> items_;
};

}  // namespace nearfield::tools
