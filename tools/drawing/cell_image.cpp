#include <tools/drawing/cell_image.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace nearfield::tools {
namespace {

constexpr double arrow_spacing = 46.0;  // pixels
constexpr double arrow_length = 30.0;

Vector2 gradient_at(const DistanceFieldResult& field, std::size_t cell) {
    return {static_cast<double>(field.gradients[2 * cell]),
            static_cast<double>(field.gradients[2 * cell + 1])};
}

/// The cell that contains a point in world coordinates, or the nearest cell.
std::size_t cell_at(const DistanceFieldResult& field, Vector2 world) {
    const auto along = [&](double coordinate, double origin, std::uint32_t count) {
        return static_cast<std::size_t>(std::clamp(std::floor((coordinate - origin) / field.cell),
                                                   0.0, static_cast<double>(count - 1)));
    };
    return along(world.y, field.origin.y, field.height) * field.width +
           along(world.x, field.origin.x, field.width);
}

}  // namespace

Rectangle covered_page(const DistanceFieldResult& field, const View& view) {
    const Vector2 high{field.origin.x + field.cell * field.width,
                       field.origin.y + field.cell * field.height};
    const Vector2 low_corner = view.to_page(field.origin);
    const Vector2 high_corner = view.to_page(high);
    return {{std::max(view.page().min.x, std::floor(low_corner.x)),
             std::max(view.page().min.y, std::floor(high_corner.y))},
            {std::min(view.page().max.x, std::ceil(high_corner.x)),
             std::min(view.page().max.y, std::ceil(low_corner.y))}};
}

void draw_cells(Canvas& canvas, const DistanceFieldResult& field, const View& view,
                const std::function<Color(std::size_t)>& color) {
    const Rectangle page = covered_page(field, view);
    const auto width = static_cast<int>(std::max(page.max.x - page.min.x, 0.0));
    const auto height = static_cast<int>(std::max(page.max.y - page.min.y, 0.0));
    std::vector<std::uint32_t> pixels;
    pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const Vector2 world =
                view.to_world({page.min.x + column + 0.5, page.min.y + row + 0.5});
            pixels.push_back(pixel_of(color(cell_at(field, world))));
        }
    }
    canvas.image(pixels, width, height, page.min);
}

Color feature_color(Feature feature) {
    // Positions along the boundary in order: a vertex, its edge, the next vertex. Golden-ratio
    // steps keep neighbouring features far apart on the hue circle.
    const bool vertex = feature.kind == Feature::Kind::vertex;
    const double place = 2.0 * feature.index + (vertex ? 0.0 : 1.0);
    const double hue = std::fmod(place * (std::numbers::phi - 1.0), 1.0);
    return vertex ? hue_color(hue, 0.06, 0.90) : hue_color(hue, 0.11, 0.72);
}

void draw_voronoi(Canvas& canvas, const DistanceFieldResult& field, const View& view) {
    draw_cells(canvas, field, view,
               [&](std::size_t cell) { return feature_color(field.features[cell]); });
}

Color direction_color(Vector2 direction) {
    const double length = std::min(std::hypot(direction.x, direction.y), 1.0);
    const double turns = std::atan2(direction.y, direction.x) / (2.0 * std::numbers::pi);
    return hue_color(turns, 0.10 * length, 0.82);
}

void draw_gradient_arrow(Canvas& canvas, Vector2 middle, Vector2 direction) {
    // The page's y axis points down.
    const Vector2 half{0.5 * arrow_length * direction.x, -0.5 * arrow_length * direction.y};
    canvas.arrow({middle.x - half.x, middle.y - half.y}, {middle.x + half.x, middle.y + half.y},
                 9.0, {palette::arrow.with_alpha(0.75), 1.6});
}

void draw_gradient(Canvas& canvas, const DistanceFieldResult& field, const View& view) {
    draw_cells(canvas, field, view,
               [&](std::size_t cell) { return direction_color(gradient_at(field, cell)); });
    const Rectangle page = covered_page(field, view);
    const auto places = [](double low, double high) {
        return static_cast<int>(std::ceil((high - low) / arrow_spacing - 0.5));
    };
    for (int row = 0; row < places(page.min.y, page.max.y); ++row) {
        for (int column = 0; column < places(page.min.x, page.max.x); ++column) {
            const Vector2 middle{page.min.x + (column + 0.5) * arrow_spacing,
                                 page.min.y + (row + 0.5) * arrow_spacing};
            draw_gradient_arrow(canvas, middle,
                                gradient_at(field, cell_at(field, view.to_world(middle))));
        }
    }
}

}  // namespace nearfield::tools
