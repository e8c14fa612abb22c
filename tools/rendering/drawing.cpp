#include <tools/rendering/drawing.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
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

namespace {

using simulation::operator+;
using simulation::operator-;
using simulation::operator*;

std::uint32_t bytes_of(const Color& color) {
    std::uint32_t bytes = 0;
    const double parts[4] = {color.red, color.green, color.blue, color.alpha};
    for (unsigned i = 0; i < 4; ++i) {
        const double part = std::clamp(parts[i], 0.0, 1.0);
        bytes |= static_cast<std::uint32_t>(std::lround(255.0 * part)) << (8U * i);
    }
    return bytes;
}

/// An edge that is not horizontal.
struct Slope {
    Vector2 top;
    Vector2 bottom;

    [[nodiscard]] double x_at(double y) const {
        return top.x + (bottom.x - top.x) * (y - top.y) / (bottom.y - top.y);
    }
};

std::vector<Slope> slopes_of(const std::vector<Ring>& rings) {
    std::vector<Slope> slopes;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& a = ring[i];
            const Vector2& b = ring[i + 1 == ring.size() ? 0 : i + 1];
            if (a.y != b.y) {
                slopes.push_back(a.y < b.y ? Slope{a, b} : Slope{b, a});
            }
        }
    }
    std::sort(slopes.begin(), slopes.end(),
              [](const Slope& a, const Slope& b) { return a.top.y < b.top.y; });
    return slopes;
}

/// The heights where edges begin, end or cross, from the top down; between two of these heights the
/// edges keep their order from left to right.
std::vector<double> heights_of(const std::vector<Slope>& slopes) {
    std::vector<double> heights;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        heights.push_back(slopes[i].top.y);
        heights.push_back(slopes[i].bottom.y);
        const Vector2 along = slopes[i].bottom - slopes[i].top;
        for (std::size_t k = i + 1; k < slopes.size() && slopes[k].top.y < slopes[i].bottom.y;
             ++k) {
            const Vector2 other = slopes[k].bottom - slopes[k].top;
            const Vector2 between = slopes[k].top - slopes[i].top;
            const double turn = simulation::cross(along, other);
            const double on_first = simulation::cross(between, other) / turn;
            const double on_second = simulation::cross(between, along) / turn;
            // Parallel edges give no such parameters.
            if (on_first > 0.0 && on_first < 1.0 && on_second > 0.0 && on_second < 1.0) {
                heights.push_back(slopes[i].top.y + on_first * along.y);
            }
        }
    }
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    return heights;
}

bool same(const Color& a, const Color& b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue && a.alpha == b.alpha;
}

/// Vertices and indices that grow primitive by primitive.
class Triangles {
public:
    Triangles(std::vector<MeshVertex>& vertices, std::vector<std::uint32_t>& indices)
        : vertices_(vertices), indices_(indices) {}

    void add(const FilledRings& item);
    void add(const DrawnLine& item);
    void add(const DrawnDot& item);
    void add(const ColoredCells& item);

private:
    /// A convex polygon.
    void polygon(const std::vector<Vector2>& corners, const Color& color);
    /// A sector of a disc that starts at the angle `from` and extends over the angle `over`.
    void sector(Vector2 center, double radius, double from, double over, const Color& color);

    std::vector<MeshVertex>& vertices_;
    std::vector<std::uint32_t>& indices_;
};

void Triangles::polygon(const std::vector<Vector2>& corners, const Color& color) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    const std::uint32_t bytes = bytes_of(color);
    for (const Vector2& corner : corners) {
        MeshVertex vertex;
        vertex.x = static_cast<float>(corner.x);
        vertex.y = static_cast<float>(corner.y);
        vertex.color = bytes;
        vertices_.push_back(vertex);
    }
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
        indices_.insert(indices_.end(), {first, first + i - 1, first + i});
    }
}

void Triangles::sector(Vector2 center, double radius, double from, double over,
                       const Color& color) {
    // This many corners make a whole disc of a small radius look round.
    const double whole = 6.0 + 3.0 * radius;
    const int pieces = static_cast<int>(std::ceil(whole * over / (2.0 * std::numbers::pi)));
    std::vector<Vector2> corners;
    for (int i = 0; i <= pieces; ++i) {
        corners.push_back(center + simulation::polar(radius, from + over * i / pieces));
    }
    polygon(corners, color);
}

// Between two heights the interior lies between the first and the second edge, the third and the
// fourth, and so on.
void Triangles::add(const FilledRings& item) {
    const std::vector<Slope> slopes = slopes_of(item.rings);
    const std::vector<double> heights = heights_of(slopes);
    std::vector<Slope> across;
    std::size_t begun = 0;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        const double top = heights[i];
        const double bottom = heights[i + 1];
        across.erase(std::remove_if(across.begin(), across.end(),
                                    [top](const Slope& edge) { return edge.bottom.y <= top; }),
                     across.end());
        for (; begun < slopes.size() && slopes[begun].top.y <= top; ++begun) {
            across.push_back(slopes[begun]);
        }
        const double middle = 0.5 * (top + bottom);
        std::sort(across.begin(), across.end(), [middle](const Slope& a, const Slope& b) {
            return a.x_at(middle) < b.x_at(middle);
        });
        for (std::size_t k = 0; k + 1 < across.size(); k += 2) {
            const Slope& left = across[k];
            const Slope& right = across[k + 1];
            polygon({{left.x_at(top), top},
                     {right.x_at(top), top},
                     {right.x_at(bottom), bottom},
                     {left.x_at(bottom), bottom}},
                    item.color);
        }
    }
}

void Triangles::add(const DrawnLine& item) {
    const std::size_t count = item.points.size();
    const std::size_t pieces = item.closed ? count : count - 1;
    const double radius = 0.5 * item.width;
    for (std::size_t i = 0; i < pieces; ++i) {
        const Vector2 from = item.points[i];
        const Vector2 to = item.points[i + 1 == count ? 0 : i + 1];
        const Vector2 along = to - from;
        const double length = simulation::length(along);
        if (length == 0.0) {
            continue;
        }
        const Vector2 aside = (radius / length) * simulation::left_of(along);
        polygon({from + aside, from - aside, to - aside, to + aside}, item.color);
        // Both ends are round; two half discs make a joint round.
        const double angle = std::atan2(along.y, along.x);
        constexpr double quarter = 0.5 * std::numbers::pi;
        sector(from, radius, angle + quarter, 2.0 * quarter, item.color);
        sector(to, radius, angle - quarter, 2.0 * quarter, item.color);
    }
}

void Triangles::add(const DrawnDot& item) {
    sector(item.center, item.radius, 0.0, 2.0 * std::numbers::pi, item.color);
}

void Triangles::add(const ColoredCells& item) {
    const Vector2 low = item.rectangle.min;
    const Vector2 high = item.rectangle.max;
    const double w = (high.x - low.x) / static_cast<double>(item.columns);
    const double h = (high.y - low.y) / static_cast<double>(item.rows);
    for (std::size_t row = 0; row < item.rows; ++row) {
        const Color* const colors = &item.colors[row * item.columns];
        const double y = low.y + h * static_cast<double>(row);
        // Neighbouring cells of the same colour form one rectangle.
        for (std::size_t from = 0, to = 0; from < item.columns; from = to) {
            while (to < item.columns && same(colors[to], colors[from])) {
                ++to;
            }
            const double left = low.x + w * static_cast<double>(from);
            const double right = low.x + w * static_cast<double>(to);
            polygon({{left, y}, {right, y}, {right, y + h}, {left, y + h}}, colors[from]);
        }
    }
}

}  // namespace

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
