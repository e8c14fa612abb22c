#include <tools/drawing/canvas.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/drawing/legend.hpp>
#include <tools/drawing/view.hpp>
#include <tools/io/answer.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

namespace nearfield::tools {
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

// The page in pixels. Text remains legible at half the size, as shown in the README.
constexpr int page_width = 1600;
constexpr int page_height = 1200;
constexpr double margin = 48.0;
constexpr double title_size = 42.0;
constexpr Rectangle overview_panel{{margin, 172.0}, {508.0, 760.0}};
constexpr Rectangle legend_area{{margin, 806.0}, {508.0, 1152.0}};
constexpr Rectangle panel_beside_colors{{548.0, 172.0}, {1430.0, 1104.0}};
constexpr Rectangle panel_alone{{548.0, 172.0}, {page_width - margin, 1104.0}};
constexpr Rectangle color_strip{{1452.0, 172.0}, {1482.0, 1104.0}};

/// The right panel, beside the colour bar if the picture has a field.
const Rectangle& detail_panel(const Answer& answer) {
    switch (answer.request.type) {
        case QueryType::distance_field:
            return answer.request.picture == FieldPicture::field ? panel_beside_colors
                                                                 : panel_alone;
        case QueryType::penetration:
        case QueryType::contacts:
            return panel_beside_colors;
        case QueryType::intersection:
        case QueryType::closest_point:
        case QueryType::separation:
        case QueryType::intersection_test:
        case QueryType::time_of_impact:
        case QueryType::separation_vector:
        case QueryType::containment:
            break;
    }
    return panel_alone;
}

using PageRings = std::vector<std::vector<Vector2>>;

PageRings rings_on_page(const FigureShape& shape, const View& view) {
    PageRings rings;
    for (const Ring& ring : shape.rings) {
        rings.push_back(view.to_page(ring));
    }
    return rings;
}

std::string title_of(const Figure& figure, Canvas& canvas) {
    const auto name = [&canvas](const FigureShape& shape) {
        return canvas.shortened(shape.name, title_size, 470.0, Weight::bold);
    };
    switch (figure.answer.request.type) {
        case QueryType::penetration:
            return "Penetration of " + name(figure.a) + " into " + name(figure.b);
        case QueryType::intersection:
            return "Intersection of " + name(figure.a) + " and " + name(figure.b);
        case QueryType::contacts:
            return "Contacts of " + name(figure.a) + " and " + name(figure.b);
        case QueryType::closest_point:
            return "Point of " + name(figure.a) + " closest to " + name(figure.b);
        case QueryType::separation:
            return "Separation of " + name(figure.a) + " and " + name(figure.b);
        case QueryType::intersection_test:
            return "Intersection test of " + name(figure.a) + " and " + name(figure.b);
        case QueryType::time_of_impact:
            return "First contact of " + name(figure.a) + " and " + name(figure.b);
        case QueryType::separation_vector:
            return "Separation of " + name(figure.a) + " from " + name(figure.b);
        case QueryType::containment:
            return "Containment of " + name(figure.a) + " in " + name(figure.b);
        case QueryType::distance_field:
            break;
    }
    switch (figure.answer.request.picture) {
        case FieldPicture::voronoi:
            return "Voronoi diagram of " + name(figure.b);
        case FieldPicture::gradient:
            return "Gradient of the distance to " + name(figure.b);
        case FieldPicture::field:
            break;
    }
    return "Signed distance to " + name(figure.b);
}

std::string facts_of(const PenetrationResult& result) {
    const std::string count = std::to_string(result.count) + " penetrating points";
    return result.count == 0 ? count
                             : count + " \u00B7 deepest " + short_number(result.deepest.depth);
}

std::string facts_of(const IntersectionResult& result) {
    return std::string(name_of(result.kind)) + " \u00B7 " + std::to_string(result.count) +
           " samples \u00B7 area " + short_number(result.area);
}

std::string facts_of(const DistanceFieldResult& result) {
    return std::to_string(result.width) + " \u00D7 " + std::to_string(result.height) +
           " cells of " + short_number(result.cell);
}

std::string facts_of(const ContactResult& result) {
    return std::to_string(result.count) + " contact points \u00B7 " +
           std::to_string(result.manifold.size()) + " stretches";
}

std::string facts_of(const ClosestPointResult& result) {
    return result.distance > 0.0 ? "distance " + short_number(result.distance)
                                 : "the shapes intersect";
}

std::string facts_of(const SeparationResult& result) {
    return result.distance > 0.0 ? "distance " + short_number(result.distance)
                                 : "the shapes intersect";
}

std::string facts_of(const IntersectionTestResult& result) {
    return result.intersects ? "the shapes intersect" : "the shapes are apart";
}

std::string facts_of(const TimeOfImpactResult& result) {
    switch (result.state) {
        case ImpactState::separated:
            return "they stay apart, by " + short_number(result.min_distance) + " at least";
        case ImpactState::intersecting_at_start:
            return "they intersect at the start";
        case ImpactState::hit:
        case ImpactState::bound_not_reached:
            break;
    }
    return (result.state == ImpactState::hit ? "hit at time " : "apart until time ") +
           short_number(result.time) + ", known to " + short_number(result.time_error_bound) +
           " \u00B7 " + std::to_string(result.steps) + " steps";
}

std::string facts_of(const SeparationVectorResult& result) {
    return result.intersects
               ? "length " + short_number(result.length) + " \u00B7 none is shorter than " +
                     short_number(result.lower_bound)
               : "the shapes are apart";
}

std::string facts_of(const ContainmentResult& result) {
    return !result.inside           ? "A is not inside B"
           : result.clearance > 0.0 ? "inside, clearance " + short_number(result.clearance)
                                    : "inside, touching";
}

void draw_header(Canvas& canvas, const Figure& figure) {
    const double width = page_width - 2.0 * margin;
    canvas.text({margin, 86.0}, title_of(figure, canvas), title_size, palette::text, Align::left,
                Weight::bold);
    const std::string facts =
        std::visit([](const auto& result) { return facts_of(result); }, figure.answer.result);
    const double tolerance = figure.answer.request.tolerance;
    const std::string& device = figure.answer.device;  // empty for technique cpu
    const std::string line =
        (tolerance > 0.0 ? "d = " + short_number(tolerance) + " \u00B7 " : std::string()) + facts +
        (device.empty() ? "" : " \u00B7 " + device);
    canvas.text({margin, 132.0}, canvas.shortened(line, 24.0, width), 24.0, palette::quiet_text);
}

/// Draws the outlines of regions or of tiles.
template <class Boxes>
void draw_boxes(Canvas& canvas, const Boxes& boxes, const View& view, const Pen& pen) {
    for (const auto& box : boxes) {
        const std::vector<Vector2> corners =
            view.to_page(Ring{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}});
        canvas.stroke(std::span(&corners, 1), pen);
    }
}

Pen trace_pen(const FigureTrace& trace, double width) {
    const Color color = trace.of == Side::a ? palette::shape_a : palette::shape_b;
    switch (trace.kind) {
        case FigureTrace::Kind::start:
            return {color, width, {9.0, 6.0}};
        case FigureTrace::Kind::on_the_way:
            return {color.with_alpha(0.35), 0.6 * width};
        case FigureTrace::Kind::end:
            break;
    }
    return {color, width, {2.5, 4.5}};
}

void draw_traces(Canvas& canvas, const Figure& figure, const View& view, double width) {
    for (const FigureTrace& trace : figure.traces) {
        canvas.stroke(rings_on_page({"", trace.rings}, view), trace_pen(trace, width));
    }
}

/// Draws an arrow from the centre of A to where the separation vector moves it.
void draw_separation_vector(Canvas& canvas, const Figure& figure,
                            const SeparationVectorResult& result, const View& view) {
    if (result.length > 0.0) {
        const Rectangle box = bounding_box(figure.a.rings);
        const Vector2 from{(box.min.x + box.max.x) / 2.0, (box.min.y + box.max.y) / 2.0};
        draw_deepest_mark(canvas, view.to_page(from),
                          view.to_page({from.x + result.vector.x, from.y + result.vector.y}));
    }
}

void draw_overview(Canvas& canvas, const Figure& figure) {
    Rectangle all = united(bounding_box(figure.a.rings), bounding_box(figure.b.rings));
    for (const FigureTrace& trace : figure.traces) {
        all = united(all, bounding_box(trace.rings));
    }
    for (const Region& region : summary_of(figure.answer.result).regions) {
        all = united(all, {region.min, region.max});
    }
    const View view(with_margin(all, 0.05), overview_panel);
    canvas.fill(overview_panel, palette::panel);
    canvas.clip(overview_panel);
    const PageRings a = rings_on_page(figure.a, view);
    const PageRings b = rings_on_page(figure.b, view);
    canvas.fill(b, palette::shape_b.with_alpha(0.28));
    canvas.fill(a, palette::shape_a.with_alpha(0.30));
    canvas.stroke(b, {palette::shape_b, 1.4});
    canvas.stroke(a, {palette::shape_a, 1.4});
    draw_traces(canvas, figure, view, 1.2);
    draw_boxes(canvas, summary_of(figure.answer.result).regions, view,
               {palette::region, 2.0, {7.0, 5.0}});
    canvas.unclip();
    canvas.stroke(overview_panel, {palette::frame, 1.5});
}

void draw_detail(Canvas& canvas, const Figure& figure, const View& view,
                 const std::optional<FieldLayer>& field) {
    canvas.fill(view.page(), palette::panel);
    canvas.clip(view.page());
    const PageRings a = rings_on_page(figure.a, view);
    const PageRings b = rings_on_page(figure.b, view);
    canvas.fill(b, palette::shape_b.with_alpha(0.14));
    canvas.fill(a, palette::shape_a.with_alpha(0.14));
    if (field) {
        field->draw_colors(canvas);
        field->draw_iso_lines(canvas);
    }
    const auto* cells = std::get_if<DistanceFieldResult>(&figure.answer.result);
    const FieldPicture picture = figure.answer.request.picture;
    if (cells != nullptr && picture == FieldPicture::voronoi) {
        draw_voronoi(canvas, *cells, view);
    } else if (cells != nullptr && picture == FieldPicture::gradient) {
        draw_gradient(canvas, *cells, view);
    }
    if (const auto* result = std::get_if<IntersectionResult>(&figure.answer.result)) {
        draw_samples(canvas, *result, view);
    }
    if (figure.answer.tiles != nullptr) {
        draw_boxes(canvas, *figure.answer.tiles, view, {palette::tile, 1.4});
    }
    draw_boxes(canvas, summary_of(figure.answer.result).regions, view,
               {palette::region.with_alpha(0.75), 1.8, {9.0, 8.0}});
    draw_traces(canvas, figure, view, 2.2);
    canvas.stroke(b, {palette::shape_b, 3.0});
    canvas.stroke(a, {palette::page.with_alpha(0.8), 5.0});
    canvas.stroke(a, {palette::shape_a, 3.0});
    if (const auto* result = std::get_if<PenetrationResult>(&figure.answer.result)) {
        draw_penetrating_points(canvas, *result, view);
    } else if (const auto* contacts = std::get_if<ContactResult>(&figure.answer.result)) {
        draw_contacts(canvas, *contacts, view);
    } else if (const auto* closest = std::get_if<ClosestPointResult>(&figure.answer.result)) {
        draw_closest_pair(canvas, view.to_page(closest->point), view.to_page(closest->nearest));
    } else if (const auto* separation = std::get_if<SeparationResult>(&figure.answer.result)) {
        draw_closest_pair(canvas, view.to_page(separation->point_a),
                          view.to_page(separation->point_b));
    }
    if (const auto* impact = std::get_if<TimeOfImpactResult>(&figure.answer.result)) {
        draw_closest_pair(canvas, view.to_page(impact->point_a), view.to_page(impact->point_b));
    } else if (const auto* way = std::get_if<SeparationVectorResult>(&figure.answer.result)) {
        draw_separation_vector(canvas, figure, *way, view);
    } else if (const auto* containment = std::get_if<ContainmentResult>(&figure.answer.result);
               containment != nullptr && containment->inside) {
        draw_closest_pair(canvas, view.to_page(containment->point_a),
                          view.to_page(containment->point_b));
    }
    draw_scale_bar(canvas, view);
    canvas.unclip();
    canvas.stroke(view.page(), {palette::frame, 1.5});
}

/// The area of interest for two closest points: both points with a margin of their distance, or the
/// whole shapes if that is 0.
Rectangle around(const Rectangle& shapes, Vector2 a, Vector2 b) {
    const double distance = std::hypot(b.x - a.x, b.y - a.y);
    if (distance == 0.0) {
        return shapes;
    }
    const Vector2 low{std::min(a.x, b.x), std::min(a.y, b.y)};
    const Vector2 high{std::max(a.x, b.x), std::max(a.y, b.y)};
    return {{low.x - distance, low.y - distance}, {high.x + distance, high.y + distance}};
}

/// The area of interest for a contact: a margin of a little over half the size of the smaller
/// shape.
Rectangle around_contact(const FigureShape& a, const FigureShape& b,
                         const TimeOfImpactResult& result) {
    const auto side = [](const FigureShape& shape) {
        const Rectangle box = bounding_box(shape.rings);
        return std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    };
    const double half = 0.6 * std::min(side(a), side(b));
    const Vector2 low{std::min(result.point_a.x, result.point_b.x),
                      std::min(result.point_a.y, result.point_b.y)};
    const Vector2 high{std::max(result.point_a.x, result.point_b.x),
                       std::max(result.point_a.y, result.point_b.y)};
    return {{low.x - half, low.y - half}, {high.x + half, high.y + half}};
}

}  // namespace

Rectangle detail_rectangle(const Answer& answer, const FigureShape& a, const FigureShape& b) {
    const std::vector<Region>& regions = summary_of(answer.result).regions;
    const Rectangle shapes = united(bounding_box(a.rings), bounding_box(b.rings));
    Rectangle box = shapes;
    if (!regions.empty()) {
        box = {regions.front().min, regions.front().max};
        for (const Region& region : regions) {
            box = united(box, {region.min, region.max});
        }
    }
    if (const auto* closest = std::get_if<ClosestPointResult>(&answer.result)) {
        box = around(shapes, closest->point, closest->nearest);
    } else if (const auto* separation = std::get_if<SeparationResult>(&answer.result)) {
        box = around(shapes, separation->point_a, separation->point_b);
    } else if (const auto* containment = std::get_if<ContainmentResult>(&answer.result)) {
        box = around(shapes, containment->point_a, containment->point_b);
    } else if (const auto* impact = std::get_if<TimeOfImpactResult>(&answer.result)) {
        box = around_contact(a, b, *impact);
    } else if (const auto* way = std::get_if<SeparationVectorResult>(&answer.result)) {
        const Rectangle rest = bounding_box(a.rings);
        box = united(shapes, {{rest.min.x + way->vector.x, rest.min.y + way->vector.y},
                              {rest.max.x + way->vector.x, rest.max.y + way->vector.y}});
    }
    return View(with_margin(box, 0.06), detail_panel(answer)).world();
}

std::string draw_figure(const Figure& figure) {
    Canvas canvas(page_width, page_height, palette::page);
    const View view(detail_rectangle(figure.answer, figure.a, figure.b),
                    detail_panel(figure.answer));
    std::optional<FieldLayer> field;
    if (figure.field != nullptr && !figure.field->values.empty() &&
        figure.answer.request.picture == FieldPicture::field) {
        field.emplace(*figure.field, view);
    }
    draw_header(canvas, figure);
    draw_overview(canvas, figure);
    draw_detail(canvas, figure, view, field);
    draw_legend(canvas, legend_of(figure, field ? &field->scale() : nullptr), legend_area);
    if (field) {
        draw_color_bar(canvas, field->scale(), color_strip);
        canvas.text({page_width - margin, 1140.0}, "signed distance to B, world units", 21.0,
                    palette::quiet_text, Align::right);
    }
    return canvas.png();
}

}  // namespace nearfield::tools
