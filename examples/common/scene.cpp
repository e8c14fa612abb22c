#include "scene.hpp"

#include <cmath>
#include <numbers>

namespace nearfield::examples {
namespace {

/// A thick C: not convex, open to the right.
std::vector<Ring> hook() {
    return {{{-1.2, -1.4},
             {1.1, -1.4},
             {1.3, -0.7},
             {-0.3, -0.6},
             {-0.4, 0.6},
             {1.3, 0.7},
             {1.1, 1.4},
             {-1.2, 1.4}}};
}

/// A star of seven points with a round hole.
std::vector<Ring> star_with_hole() {
    Ring star;
    for (int i = 0; i < 14; ++i) {
        const double angle = std::numbers::pi * i / 7;
        const double radius = i % 2 == 0 ? 1.25 : 0.75;
        star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    Ring hole;
    for (int i = 0; i < 24; ++i) {
        const double angle = std::numbers::pi * i / 12;
        hole.push_back({0.4 * std::cos(angle), 0.4 * std::sin(angle)});
    }
    return {star, hole};
}

}  // namespace

Scene::Scene() : bodies_{{{hook(), {{-1.6, 0.0}, 0.1}}, {star_with_hole(), {{1.9, 0.3}, 0.2}}}} {}

void Scene::press(const Vector2& mouse) {
    for (std::size_t i = bodies_.size(); i-- > 0;) {  // the body drawn last is on top
        if (contains(bodies_[i], mouse)) {
            const Vector2& at = bodies_[i].pose.translation;
            held_ = Hold{i, {at.x - mouse.x, at.y - mouse.y}};
            return;
        }
    }
}

void Scene::move(const Vector2& mouse) {
    if (held_) {
        bodies_[held_->body].pose.translation = {mouse.x + held_->offset.x,
                                                 mouse.y + held_->offset.y};
        ++version_;
    }
}

Vector2 place(const Pose& pose, const Vector2& point) {
    const double cosine = std::cos(pose.angle);
    const double sine = std::sin(pose.angle);
    return {pose.translation.x + cosine * point.x - sine * point.y,
            pose.translation.y + sine * point.x + cosine * point.y};
}

bool contains(const Body& body, const Vector2& point) {
    bool inside = false;
    for (const Ring& ring : body.rings) {
        Vector2 from = place(body.pose, ring.back());
        for (const Vector2& vertex : ring) {
            const Vector2 to = place(body.pose, vertex);
            const bool spans = (from.y > point.y) != (to.y > point.y);
            if (spans &&
                point.x < from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y)) {
                inside = !inside;
            }
            from = to;
        }
    }
    return inside;
}

Vector2 View::to_pixel(const Vector2& world) const {
    return {width_in_pixels / 2 + world.x * pixels_per_unit(),
            height_in_pixels / 2 - world.y * pixels_per_unit()};
}

Vector2 View::to_world(const Vector2& pixel) const {
    return {(pixel.x - width_in_pixels / 2) / pixels_per_unit(),
            (height_in_pixels / 2 - pixel.y) / pixels_per_unit()};
}

Vector2 drag_position(const Vector2& by, int step) {
    const double part = static_cast<double>(step) / drag_steps;
    return {drag_from.x + part * by.x, drag_from.y + part * by.y};
}

}  // namespace nearfield::examples
