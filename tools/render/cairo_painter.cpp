#include <tools/picture/canvas.hpp>
#include <tools/render/cairo_painter.hpp>

#include <span>

namespace nearfield::tools {
namespace {

void put(Canvas& canvas, const FilledRings& item) {
    canvas.fill(item.rings, item.color);
}

void put(Canvas& canvas, const DrawnLine& item) {
    const Pen pen{item.color, item.width};
    if (item.closed) {
        canvas.stroke(std::span(&item.points, 1), pen);
    } else {
        canvas.stroke_open(std::span(&item.points, 1), pen);
    }
}

void put(Canvas& canvas, const DrawnDot& item) {
    canvas.dot(item.center, item.radius, item.color);
}

void put(Canvas& canvas, const ColoredCells& item) {
    const double w =
        (item.rectangle.max.x - item.rectangle.min.x) / static_cast<double>(item.columns);
    const double h = (item.rectangle.max.y - item.rectangle.min.y) / static_cast<double>(item.rows);
    for (std::size_t i = 0; i < item.colors.size(); ++i) {
        const Vector2 low{item.rectangle.min.x + w * static_cast<double>(i % item.columns),
                          item.rectangle.min.y + h * static_cast<double>(i / item.columns)};
        canvas.fill(Rectangle{low, {low.x + w, low.y + h}}, item.colors[i]);
    }
}

}  // namespace

FrameImage paint(const Drawing& drawing, const View& view) {
    const int width = static_cast<int>(view.page().max.x);
    const int height = static_cast<int>(view.page().max.y);
    Canvas canvas(width, height, palette::panel);
    for (const DrawnItem& item : drawing.items()) {
        std::visit([&canvas](const auto& any) { put(canvas, any); }, item);
    }
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), canvas.pixels()};
}

}  // namespace nearfield::tools
