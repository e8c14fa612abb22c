#include <tools/drawing/canvas.hpp>
#include <tools/drawing/marks.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace nearfield::tools {
namespace {

constexpr std::size_t max_arrows = 150;
constexpr double min_spacing = 8.0;  // pixels between drawn dots

/// The stride through the records that avoids drawing too many arrows.
std::size_t arrow_stride(std::size_t count) {
    return (count + max_arrows - 1) / max_arrows;
}

/// The points of the records on the page, without those that would cover the previous one.
std::vector<Vector2> spaced_points(const PenetrationResult& result, const View& view) {
    std::vector<Vector2> points;
    for (const PenetratingPoint& record : result.points) {
        const Vector2 point = view.to_page(record.position);
        if (points.empty() ||
            std::hypot(point.x - points.back().x, point.y - points.back().y) >= min_spacing) {
            points.push_back(point);
        }
    }
    return points;
}

}  // namespace

void draw_point_mark(Canvas& canvas, Vector2 point) {
    canvas.dot(point, 4.4, palette::page);
    canvas.dot(point, 3.3, palette::shape_a);
}

void draw_way_out(Canvas& canvas, Vector2 point, Vector2 nearest) {
    canvas.arrow(point, nearest, 10.0, {palette::arrow.with_alpha(0.62), 1.4});
}

void draw_deepest_mark(Canvas& canvas, Vector2 point, Vector2 nearest) {
    const double length = std::hypot(nearest.x - point.x, nearest.y - point.y);
    const double inset = length > 24.0 ? 5.0 / length : 0.0;  // leaves a dark edge at the tip
    const Vector2 tip{nearest.x - inset * (nearest.x - point.x),
                      nearest.y - inset * (nearest.y - point.y)};
    canvas.arrow(point, nearest, 26.0, {palette::text, 8.0});
    canvas.arrow(point, tip, 18.0, {palette::highlight, 4.5});
    canvas.dot(point, 10.0, palette::text);
    canvas.dot(point, 7.5, palette::highlight);
}

void draw_sample_mark(Canvas& canvas, Vector2 center, double side) {
    const double half = std::max(side, 1.0) / 2.0;
    canvas.fill({{center.x - half, center.y - half}, {center.x + half, center.y + half}},
                palette::sample);
}

void draw_samples(Canvas& canvas, const IntersectionResult& result, const View& view) {
    // Large cells get a thin gap that shows the grid.
    const double cell = result.cell * view.scale();
    double side = cell > 6.0 ? cell - 1.0 : cell;
    if (result.kind != IntersectionKind::volume_volume) {
        side = std::max(side, 8.0);  // marks follow an outline and must be visible beside it
    }
    for (const IntersectionSample& sample : result.samples) {
        draw_sample_mark(canvas, view.to_page(sample.position), side);
    }
}

void draw_penetrating_points(Canvas& canvas, const PenetrationResult& result, const View& view) {
    const std::size_t count = result.points.size();
    for (std::size_t index = 0; index < count; index += arrow_stride(count)) {
        const PenetratingPoint& record = result.points[index];
        draw_way_out(canvas, view.to_page(record.position), view.to_page(record.nearest));
    }
    for (const Vector2& point : spaced_points(result, view)) {
        draw_point_mark(canvas, point);
    }
    if (result.count > 0) {
        draw_deepest_mark(canvas, view.to_page(result.deepest.position),
                          view.to_page(result.deepest.nearest));
    }
}

void draw_contact_mark(Canvas& canvas, Vector2 point, Vector2 tip) {
    canvas.arrow(point, tip, 9.0, {palette::arrow.with_alpha(0.62), 1.4});
}

void draw_stretch_mark(Canvas& canvas, Vector2 first, Vector2 last) {
    const std::vector<Vector2> line{first, last};
    canvas.stroke_open(std::span(&line, 1), {palette::text, 6.0});
    canvas.stroke_open(std::span(&line, 1), {palette::highlight, 3.0});
    for (const Vector2& end : line) {
        canvas.dot(end, 8.5, palette::text);
        canvas.dot(end, 6.0, palette::highlight);
    }
}

void draw_closest_pair(Canvas& canvas, Vector2 on_a, Vector2 on_b) {
    const std::vector<Vector2> line{on_a, on_b};
    canvas.stroke_open(std::span(&line, 1), {palette::text, 8.0});
    canvas.stroke_open(std::span(&line, 1), {palette::highlight, 4.5});
    canvas.dot(on_a, 10.0, palette::text);
    canvas.dot(on_a, 7.5, palette::shape_a);
    canvas.dot(on_b, 10.0, palette::text);
    canvas.dot(on_b, 7.5, palette::shape_b);
}

void draw_contacts(Canvas& canvas, const ContactResult& result, const View& view) {
    constexpr double normal_length = 34.0;  // pixels
    const auto tip = [&](Vector2 point, Vector2 normal, double length) {
        return Vector2{point.x + length * normal.x, point.y - length * normal.y};
    };
    const std::size_t stride = arrow_stride(result.points.size());
    for (std::size_t index = 0; index < result.points.size(); ++index) {
        const ContactPoint& contact = result.points[index];
        const Vector2 point = view.to_page(contact.position);
        if (index % stride == 0) {
            draw_contact_mark(canvas, point, tip(point, contact.normal, normal_length));
        }
        canvas.dot(point, 3.6, palette::page);
        canvas.dot(point, 2.6, contact.on == Side::a ? palette::shape_a : palette::shape_b);
    }
    for (const ContactCluster& cluster : result.manifold) {
        draw_stretch_mark(canvas, view.to_page(cluster.first), view.to_page(cluster.last));
        const Vector2 point = view.to_page(cluster.extreme.position);
        const Vector2 end = tip(point, cluster.normal, 2.0 * normal_length);
        canvas.arrow(point, end, 20.0, {palette::text, 6.5});
        canvas.arrow(point, tip(point, cluster.normal, 2.0 * normal_length - 4.0), 15.0,
                     {palette::highlight, 3.5});
    }
}

}  // namespace nearfield::tools
