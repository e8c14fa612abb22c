#include <tools/drawing/canvas.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/drawing/figure.hpp>
#include <tools/drawing/legend.hpp>
#include <tools/drawing/marks.hpp>
#include <tools/drawing/view.hpp>
#include <tools/io/summary.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace nearfield::tools {
namespace {

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
