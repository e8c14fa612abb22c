#include <tools/rendering/scene_picture.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
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

}  // namespace

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

namespace {

using simulation::operator+;
using simulation::operator-;
using simulation::operator*;

constexpr Color penetrating_color = rgb(0xC2185B);
constexpr Color contact_color = rgb(0x1B2430);

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

}  // namespace nearfield::tools
