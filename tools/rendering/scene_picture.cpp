#include <tools/rendering/scene_picture.hpp>
#include <tools/rendering/solids.hpp>
#include <tools/simulation/plane.hpp>

#include <algorithm>

namespace nearfield::tools {
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
