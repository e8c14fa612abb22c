#include <tools/rendering/drawing.hpp>
#include <tools/rendering/triangles.hpp>

#include <cmath>
#include <utility>
#include <variant>

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

void Mesh::add(const Drawing& drawing) {
    const auto first = static_cast<std::uint32_t>(indices_.size());
    Triangles triangles(vertices_, indices_);
    for (const DrawnItem& item : drawing.items()) {
        std::visit([&triangles](const auto& any) { triangles.add(any); }, item);
    }
    parts_.push_back(
        {0, 0, width_, height_, first, static_cast<std::uint32_t>(indices_.size()) - first});
}

void Mesh::add(std::span<const MeshVertex> vertices, std::span<const std::uint16_t> indices,
               std::span<const MeshPart> parts) {
    const auto base = static_cast<std::uint32_t>(vertices_.size());
    const auto first = static_cast<std::uint32_t>(indices_.size());
    vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
    for (const std::uint16_t index : indices) {
        indices_.push_back(base + index);
    }
    for (MeshPart part : parts) {
        part.first += first;
        parts_.push_back(part);
    }
}

}  // namespace nearfield::tools
