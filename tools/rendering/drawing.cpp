#include <tools/rendering/drawing.hpp>

#include <cmath>
#include <utility>

namespace nearfield::tools {

void Drawing::fill(std::vector<Ring> rings, const Color& color) {
    items_.emplace_back(FilledRings{std::move(rings), color});
}

void Drawing::line(std::vector<Vector2> points, const Color& color, double width, bool closed) {
    items_.emplace_back(DrawnLine{std::move(points), closed, color, width});
}

void Drawing::dot(Vector2 center, double radius, const Color& color) {
    items_.emplace_back(DrawnDot{center, radius, color});
}

void Drawing::arrow(Vector2 from, Vector2 to, double head, const Color& color, double width) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length < head) {
        line({from, to}, color, width);
        return;
    }
    const Vector2 along{(to.x - from.x) / length, (to.y - from.y) / length};
    const Vector2 base{to.x - along.x * head, to.y - along.y * head};
    const double half_width = 0.38 * head;
    line({from, base}, color, width);
    fill({{to,
           {base.x - along.y * half_width, base.y + along.x * half_width},
           {base.x + along.y * half_width, base.y - along.x * half_width}}},
         color);
}

void Drawing::cells(ColoredCells cells) {
    items_.emplace_back(std::move(cells));
}

void Drawing::text(Vector2 position, const std::string& text, double size, const Color& color,
                   Align align) {
    Canvas letters(1, 1, color);
    for (std::vector<Ring>& character : letters.text_outlines(position, text, size, align)) {
        fill(std::move(character), color);
    }
}

}  // namespace nearfield::tools
