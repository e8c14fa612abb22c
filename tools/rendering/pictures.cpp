#include <tools/common/library.hpp>
#include <tools/drawing/field_layer.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/world_report.hpp>
#include <tools/rendering/pictures.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

namespace nearfield::tools {
namespace {

using simulation::operator+;
using simulation::operator-;
using simulation::operator*;

/// The direction of the light, seen from above.
constexpr Vector2 light{-0.6, 0.8};

/// Oblique projection: higher points are higher on the page.
Vector2 raised(const View& view, Vector2 ground, double height) {
    constexpr double slant = 0.75;
    const Vector2 page = view.to_page(ground);
    return {page.x, page.y - slant * height * view.scale()};
}

Ring outline_of(const simulation::Body& body, double scale, double ahead) {
    Ring ring;
    ring.reserve(body.rings().front().size());
    const Pose pose = body.pose();
    for (const Vector2& vertex : body.rings().front()) {
        ring.push_back(
            simulation::placed(pose, {scale * vertex.x + ahead, 0.86 * scale * vertex.y}));
    }
    return ring;
}

/// Draws the sides that face the viewer, then the top. `low` and `high` are heights above the
/// ground. The lower ring may be wider than the upper one.
void draw_prism(Drawing& drawing, const View& view, const Ring& lower, const Ring& upper,
                double low, double high, double hue, double lightness, double chroma) {
    const std::size_t n = lower.size();
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        const Vector2 along = lower[next] - lower[i];
        const double length = simulation::length(along);
        const Vector2 outward = (length > 0.0 ? 1.0 / length : 0.0) * Vector2{along.y, -along.x};
        // Part of a leaning side is visible even if it faces away.
        const double shade = 0.5 + 0.5 * simulation::dot(outward, light);
        const Color color = hue_color(hue, chroma, lightness * (0.55 + 0.4 * shade));
        const Ring face{raised(view, lower[i], low), raised(view, lower[next], low),
                        raised(view, upper[next], high), raised(view, upper[i], high)};
        const bool seen = simulation::cross(face[1] - face[0], face[2] - face[0]) < 0.0 ||
                          simulation::cross(face[2] - face[0], face[3] - face[0]) < 0.0;
        if (seen) {
            drawing.fill({face}, color);
            drawing.line(face, color, 0.6, true);
        }
    }
    Ring top;
    top.reserve(n);
    for (const Vector2& vertex : upper) {
        top.push_back(raised(view, vertex, high));
    }
    drawing.fill({top}, hue_color(hue, chroma, lightness));
    drawing.line(std::move(top), hue_color(hue, chroma, 0.5 * lightness), 0.8, true);
}

void draw_shadow(Drawing& drawing, const simulation::Body& body, double height, const View& view) {
    Ring shadow;
    shadow.reserve(body.rings().front().size());
    const Pose pose = body.pose();
    for (const Vector2& vertex : body.rings().front()) {
        shadow.push_back(view.to_page(simulation::placed(pose, vertex) - 0.35 * height * light));
    }
    drawing.fill({std::move(shadow)}, rgb(0x000000).with_alpha(0.22));
}

void draw_car(Drawing& drawing, const simulation::Body& body, const simulation::Look& look,
              const View& view) {
    const Ring base = outline_of(body, 1.0, 0.0);
    const Ring bonnet = outline_of(body, 0.94, 0.0);
    const double waist = 0.5 * look.height;
    draw_prism(drawing, view, base, bonnet, 0.1 * look.height, waist, look.hue, 0.72, 0.13);
    const Ring sill = outline_of(body, 0.62, -0.05);
    const Ring roof = outline_of(body, 0.46, -0.06);
    draw_prism(drawing, view, sill, roof, waist, 0.85 * look.height, look.hue + 0.02, 0.55, 0.03);
    // The roof in the car's colour, and headlights.
    Ring top;
    top.reserve(roof.size());
    for (const Vector2& vertex : roof) {
        top.push_back(raised(view, vertex, 0.86 * look.height));
    }
    drawing.fill({std::move(top)}, hue_color(look.hue, 0.13, 0.8));
    for (const double side : {-1.0, 1.0}) {
        const Vector2 lamp = simulation::placed(body.pose(), {0.43, 0.13 * side});
        drawing.dot(raised(view, lamp, 0.42 * look.height), 0.035 * view.scale(), rgb(0xFFF4C2));
    }
}

void draw_ground(Drawing& drawing, const View& view) {
    const Rectangle& page = view.page();
    drawing.fill({{page.min, {page.max.x, page.min.y}, page.max, {page.min.x, page.max.y}}},
                 rgb(0xB9BEC4));
    const Color tile = rgb(0xA9AFB7);
    const Rectangle& world = view.world();
    const auto first_and_end = [](double low, double high) {
        return std::pair(static_cast<int>(std::ceil(low)), static_cast<int>(std::ceil(high)));
    };
    const auto [first_x, end_x] = first_and_end(world.min.x, world.max.x);
    for (int x = first_x; x < end_x; ++x) {
        drawing.line({view.to_page(Vector2{1.0 * x, world.min.y}),
                      view.to_page(Vector2{1.0 * x, world.max.y})},
                     tile, 1.0);
    }
    const auto [first_y, end_y] = first_and_end(world.min.y, world.max.y);
    for (int y = first_y; y < end_y; ++y) {
        drawing.line({view.to_page(Vector2{world.min.x, 1.0 * y}),
                      view.to_page(Vector2{world.max.x, 1.0 * y})},
                     tile, 1.0);
    }
}

/// The ground and the bodies of a scene as solids on it: convex outlines with a height, wheels and
/// a cabin, seen from the south and above. Ground positions are those of the flat picture, so
/// contacts and normals drawn over it fit.
void draw_solids(Drawing& drawing, const simulation::Scene& scene, const View& view) {
    draw_ground(drawing, view);
    std::vector<std::size_t> order(scene.bodies.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Far bodies first, since near ones cover them.
    std::sort(order.begin(), order.end(), [&scene](std::size_t a, std::size_t b) {
        return scene.bodies[a]->center().y > scene.bodies[b]->center().y;
    });
    for (const std::size_t i : order) {
        draw_shadow(drawing, *scene.bodies[i], scene.looks[i].height, view);
    }
    for (const std::size_t i : order) {
        draw_car(drawing, *scene.bodies[i], scene.looks[i], view);
    }
}

constexpr Color penetrating_color = rgb(0xC2185B);
constexpr Color contact_color = rgb(0x1B2430);

/// The outlines of a shape at a pose, in pixels of the page.
std::vector<Ring> on_page(const std::vector<Ring>& rings, const Pose& pose, const View& view) {
    std::vector<Ring> placed;
    for (const Ring& ring : rings) {
        Ring& copy = placed.emplace_back();
        for (const Vector2& vertex : ring) {
            copy.push_back(view.to_page(simulation::placed(pose, vertex)));
        }
    }
    return placed;
}

void draw_plate(Drawing& drawing, const simulation::Body& body, const simulation::Look& look,
                const View& view) {
    const std::vector<Ring> rings = on_page(body.rings(), body.pose(), view);
    drawing.fill(rings, hue_color(look.hue, 0.1, 0.82).with_alpha(0.85));
    for (const Ring& ring : rings) {
        drawing.line(ring, hue_color(look.hue, 0.11, 0.42), 1.4, true);
    }
}

/// Points along a boundary are closer than pixels, so a subset suffices.
template <class Record>
std::vector<const Record*> thinned_out(const std::vector<Record>& records, const View& view) {
    constexpr double min_pixels = 7.0;
    std::vector<const Record*> kept;
    for (const Record& record : records) {
        if (kept.empty() ||
            view.scale() * simulation::length(record.position - kept.back()->position) >=
                min_pixels) {
            kept.push_back(&record);
        }
    }
    return kept;
}

}  // namespace

Observations observe(simulation::World& world) {
    Observations observations;
    for (const auto& overlap : world.proximity().overlaps()) {
        for (const PenetrationResult* result : {overlap.first_in_second, overlap.second_in_first}) {
            observations.penetrating.insert(observations.penetrating.end(), result->points.begin(),
                                            result->points.end());
        }
    }
    for (const auto& touching : world.proximity().contacts(2.0 * world.scene().tolerance)) {
        observations.contacts.insert(observations.contacts.end(), touching.contacts->points.begin(),
                                     touching.contacts->points.end());
    }
    return observations;
}

void draw_bodies(Drawing& drawing, const simulation::Scene& scene, const View& view) {
    if (std::any_of(scene.looks.begin(), scene.looks.end(),
                    [](const simulation::Look& look) { return look.height > 0.0; })) {
        draw_solids(drawing, scene, view);
        return;
    }
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        draw_plate(drawing, *scene.bodies[i], scene.looks[i], view);
    }
}

void draw_observations(Drawing& drawing, const Observations& observations, const View& view) {
    for (const ContactPoint* record : thinned_out(observations.contacts, view)) {
        const Vector2 point = view.to_page(record->position);
        drawing.line({point, point + Vector2{11.0 * record->normal.x, -11.0 * record->normal.y}},
                     contact_color.with_alpha(0.8), 1.1);
        drawing.dot(point, 1.8, contact_color);
    }
    for (const PenetratingPoint* record : thinned_out(observations.penetrating, view)) {
        constexpr double shortest = 12.0;
        const Vector2 point = view.to_page(record->position);
        const double length = shortest + view.scale() * record->depth;
        drawing.arrow(point,
                      point + Vector2{length * record->direction.x, -length * record->direction.y},
                      6.0, penetrating_color, 1.4);
        drawing.dot(point, 2.0, penetrating_color);
    }
}

namespace {

constexpr double pixels_a_cell = 4.0;

Color distance_color(double value, double reach) {
    // Bands of equal distance, an eighth of the reach wide.
    const double position = std::clamp(value / reach, -1.0, 1.0);
    return diverging_color(std::floor(8.0 * position) / 8.0 + 0.06);
}

/// Features with equal numbers have different colours on different bodies.
Color body_feature_color(std::size_t body, Feature feature) {
    feature.index += 37 * static_cast<std::uint32_t>(body);
    return feature_color(feature);
}

Color banded_direction_color(float x, float y) {
    constexpr double bands = 32.0;
    constexpr double turn = 2.0 * std::numbers::pi;
    const double angle = std::atan2(static_cast<double>(y), static_cast<double>(x));
    return direction_color(simulation::polar(1.0, turn * std::round(bands * angle / turn) / bands));
}

Batch fields_of(const simulation::Proximity& proximity, const View& view, FieldOverlay layer) {
    Batch batch;
    DistanceFieldQuery query;
    query.tolerance = pixels_a_cell / view.scale() / std::sqrt(2.0);
    query.rectangle = view.world();
    query.features = layer == FieldOverlay::features;
    query.gradients = layer == FieldOverlay::gradient;
    for (const Instance& instance : proximity.instances()) {
        query.b = instance;
        batch.add(query);
    }
    return batch;
}

}  // namespace

ColoredCells field_overlay(Context& context, simulation::World& world, const View& view,
                           FieldOverlay layer) {
    const Batch batch = fields_of(world.proximity(), view, layer);
    Results results;
    require(context.run(batch, results), "the distance field");
    std::vector<const DistanceFieldResult*> fields;
    for (std::uint32_t i = 0; i < batch.queries().size(); ++i) {
        fields.push_back(&results[QueryHandle<DistanceFieldQuery>{i}]);
        require(fields.back()->status, "the distance field");
    }
    const DistanceFieldResult& first = *fields.front();
    const Vector2 high =
        first.origin + Vector2{first.cell * first.width, first.cell * first.height};
    ColoredCells cells{
        {view.to_page(first.origin), view.to_page(high)}, first.width, first.height, {}};
    const double reach = 0.12 * (view.world().max.x - view.world().min.x);
    for (std::size_t cell = 0; cell < first.values.size(); ++cell) {
        const auto nearest =
            std::min_element(fields.begin(), fields.end(),
                             [cell](const DistanceFieldResult* a, const DistanceFieldResult* b) {
                                 return a->values[cell] < b->values[cell];
                             });
        const DistanceFieldResult& field = **nearest;
        if (layer == FieldOverlay::features) {
            const auto body = static_cast<std::size_t>(nearest - fields.begin());
            cells.colors.push_back(body_feature_color(body, field.features[cell]));
        } else if (layer == FieldOverlay::gradient) {
            cells.colors.push_back(
                banded_direction_color(field.gradients[2 * cell], field.gradients[2 * cell + 1]));
        } else {
            cells.colors.push_back(distance_color(static_cast<double>(field.values[cell]), reach));
        }
    }
    return cells;
}

namespace {

using simulation::ClearanceFrame;
using simulation::ClearanceScene;

constexpr double band_height = 66.0;
constexpr double bar_height = 14.0;
constexpr double small = 12.5;
constexpr double large = 17.0;

/// The bar of colours: to the left of `zero` depths, to the right of it clearances.
struct Bar {
    double left = 0.0;
    double zero = 0.0;
    double right = 0.0;
    double top = 0.0;
    bool has_depths = true;  ///< otherwise all overlaps have the colour of contact

    [[nodiscard]] double x_at(double position) const {
        return position < 0.0 ? zero + position * (zero - left) : zero + position * (right - zero);
    }
};

void draw_bar(Drawing& drawing, const Bar& bar) {
    ColoredCells cells;
    cells.rectangle = {{bar.left, bar.top}, {bar.right, bar.top + bar_height}};
    cells.columns = static_cast<std::size_t>(bar.right - bar.left);
    cells.rows = 1;
    for (std::size_t column = 0; column < cells.columns; ++column) {
        const double x = bar.left + static_cast<double>(column) + 0.5;
        const double side = x < bar.zero ? bar.zero - bar.left : bar.right - bar.zero;
        cells.colors.push_back(
            clearance_color(x < bar.zero && !bar.has_depths ? 0.0 : (x - bar.zero) / side));
    }
    drawing.cells(std::move(cells));
}

void draw_mark(Drawing& drawing, Vector2 tip) {
    drawing.fill({{tip, {tip.x - 6.0, tip.y - 9.0}, {tip.x + 6.0, tip.y - 9.0}}}, palette::text);
}

/// 80000 as "80,000".
std::string count_text(std::size_t count) {
    std::string text = std::to_string(count);
    for (std::size_t place = text.size(); place > 3; place -= 3) {
        text.insert(place - 3, ",");
    }
    return text;
}

std::string in_thousandths(double number) {
    return short_number(std::round(1000.0 * number) / 1000.0);
}

std::string finding(const ClearanceScene& scene) {
    const Clearance& clearance = scene.frame().clearance;
    const std::string subject = scene.frame().paths > 1 ? "best path: " : "";
    if (clearance.distance > 0.0) {
        const bool beyond = clearance.distance == scene.query().max_clearance;
        return subject + "clearance " + (beyond ? "at least " : "") +
               in_thousandths(clearance.distance);
    }
    return subject + "overlap" +
           (clearance.distance < 0.0 ? ", depth " + in_thousandths(-clearance.distance) : "");
}

std::string question(const ClearanceFrame& frame) {
    if (frame.paths == 1) {
        return "coloured by its clearance from all others and the strip's edge";
    }
    return count_text(frame.free_paths) + " of " + count_text(frame.paths) + " paths are free, " +
           count_text(frame.poses) + " poses in one call";
}

/// Adds the scale of the colours with a mark at the last frame's clearance, and what this frame
/// asked and found, at the lower edge of the page.
void draw_clearance_legend(Drawing& drawing, const ClearanceScene& scene, const Rectangle& page) {
    const ClearanceQuery query = scene.query();
    Bar bar;
    bar.has_depths = query.min_clearance < 0.0;
    bar.left = page.min.x + 26.0;
    bar.zero = bar.left + (bar.has_depths ? 170.0 : 76.0);
    bar.right = bar.zero + 170.0;
    bar.top = page.max.y - 46.0;
    drawing.cells({{{page.min.x, page.max.y - band_height}, page.max}, 1, 1, {palette::page}});
    drawing.line({{page.min.x, page.max.y - band_height}, {page.max.x, page.max.y - band_height}},
                 palette::frame, 1.0);
    draw_bar(drawing, bar);
    draw_mark(
        drawing,
        {bar.x_at(std::clamp(scene.frame().clearance.distance / query.max_clearance, -1.0, 1.0)),
         bar.top - 1.0});
    const double ticks = bar.top + bar_height + 16.0;
    const std::string most = short_number(query.max_clearance);
    drawing.text({bar.right, ticks}, most, small, palette::quiet_text, Align::center);
    drawing.text({bar.zero, ticks}, "0", small, palette::quiet_text, Align::center);
    drawing.text({0.5 * (bar.zero + bar.right), ticks}, "clearance", small, palette::quiet_text,
                 Align::center);
    if (bar.has_depths) {
        drawing.text({bar.left, ticks}, most, small, palette::quiet_text, Align::center);
    }
    drawing.text({0.5 * (bar.left + bar.zero), ticks}, bar.has_depths ? "depth" : "overlap", small,
                 palette::quiet_text, Align::center);
    const double text = bar.right + 36.0;
    drawing.text({text, bar.top + 9.0}, finding(scene), large, palette::text);
    drawing.text({text, ticks}, question(scene.frame()), small, palette::quiet_text);
}

constexpr Color obstacle_color = rgb(0xD7DCE3);
constexpr Color obstacle_line = rgb(0x8893A2);
constexpr Color neighbor_line = palette::text;

void draw_shape(Drawing& drawing, std::vector<Ring> rings, const Color& fill, const Color& line,
                double width) {
    for (const Ring& ring : rings) {
        drawing.line(ring, line, width, true);
    }
    drawing.fill(std::move(rings), fill);
}

void draw_obstacles(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    for (std::size_t i = 0; i < scene.obstacles().size(); ++i) {
        if (scene.moving_obstacle() == i) {
            continue;
        }
        const simulation::Obstacle& obstacle = scene.obstacles()[i];
        const bool nearest = scene.frame().neighbor == i;
        draw_shape(drawing, on_page(obstacle.rings, obstacle.pose, view), obstacle_color,
                   nearest ? neighbor_line : obstacle_line, nearest ? 2.4 : 1.6);
    }
}

/// A path on the page. Every second pose is enough for a smooth line.
std::vector<Vector2> line_of(std::span<const Pose> path, const View& view) {
    std::vector<Vector2> line;
    for (std::size_t i = 0; i < path.size(); i += 2) {
        line.push_back(view.to_page(path[i].translation));
    }
    return line;
}

/// The clearest paths come last, and cover the others.
void draw_paths(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    std::vector<std::size_t> order(scene.frame().paths);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&scene](std::size_t a, std::size_t b) {
        return scene.clearance(a).distance < scene.clearance(b).distance;
    });
    for (const std::size_t path : order) {
        const double clearance = scene.clearance(path).distance;
        const Color color = clearance_color(clearance / scene.query().max_clearance);
        drawing.line(line_of(scene.path(path), view),
                     clearance > 0.0 ? color : color.with_alpha(0.12), 1.0);
    }
}

/// The best path, with the shape where it is least clear.
void draw_best_path(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    const std::span<const Pose> path = scene.path(scene.frame().best_path);
    const std::vector<Vector2> line = line_of(path, view);
    drawing.line(line, palette::page, 6.0);
    drawing.line(line, palette::text, 2.6);
    constexpr std::size_t pause = 6;
    for (std::size_t i = pause; i < path.size(); i += pause) {
        for (Ring& ring : on_page(scene.mover(), path[i], view)) {
            drawing.line(std::move(ring), palette::text, 1.2, true);
        }
    }
}

void draw_goal(Drawing& drawing, Vector2 goal) {
    drawing.dot(goal, 13.0, palette::text);
    drawing.dot(goal, 10.0, palette::page);
    drawing.dot(goal, 5.5, palette::shape_a);
}

/// The nearest points with a line between them, or at a vertex that is inside, the way out.
void draw_nearest(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    const Clearance& clearance = scene.frame().clearance;
    if (!is_direction(clearance.direction)) {
        return;
    }
    const Vector2 from = view.to_page(clearance.point);
    const Vector2 to = view.to_page(clearance.nearest);
    drawing.line({from, to}, palette::page, 5.0);
    drawing.line({from, to}, palette::text, 2.0);
    for (const Vector2& end : {from, to}) {
        drawing.dot(end, 5.0, palette::page);
        drawing.dot(end, 3.6, palette::text);
    }
}

}  // namespace

void draw_clearances(Drawing& drawing, const ClearanceScene& scene, const View& view) {
    draw_obstacles(drawing, scene, view);
    const bool along_paths = scene.path(0).size() > 1;
    if (along_paths) {
        draw_paths(drawing, scene, view);
        draw_best_path(drawing, scene, view);
    }
    if (scene.goal()) {
        draw_goal(drawing, view.to_page(*scene.goal()));
    }
    const double clearance = scene.frame().clearance.distance;
    draw_shape(drawing, on_page(scene.mover(), scene.pose(), view),
               clearance_color(clearance / scene.query().max_clearance).with_alpha(0.9),
               palette::text, 2.4);
    draw_nearest(drawing, scene, view);
    draw_clearance_legend(drawing, scene, view.page());
}

}  // namespace nearfield::tools
