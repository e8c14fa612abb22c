#include <tools/simulation/plane.hpp>
#include <tools/viewer/drag.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::viewer {
namespace {

using simulation::operator+;
using simulation::operator-;
using simulation::operator*;
using simulation::operator+=;

/// The natural frequency of the dragged part on the spring, radians per second: as stiff as steps
/// of a few milliseconds allow. The held part of a deformable body is light, and its springs pull
/// back.
constexpr double rigid_frequency = 16.0;
constexpr double deformable_frequency = 60.0;
/// The fraction of a deformable body's boundary that is held, on each side of the point.
constexpr double held_fraction = 0.05;

Vector2 into_body(const Pose& pose, Vector2 point) {
    return simulation::rotated(point - pose.translation, -pose.angle);
}

bool is_inside(const std::vector<Ring>& rings, Vector2 point) {
    bool inside = false;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& a = ring[i];
            const Vector2& b = ring[i + 1 == ring.size() ? 0 : i + 1];
            if ((a.y > point.y) != (b.y > point.y) &&
                point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) {
                inside = !inside;
            }
        }
    }
    return inside;
}

}  // namespace

bool Drag::grab(const simulation::Scene& scene, Vector2 point) {
    release();
    target_ = point;
    for (std::size_t i = scene.bodies.size(); i-- > 0;) {
        const simulation::Body& body = *scene.bodies[i];
        const Vector2 own_place = into_body(body.pose(), point);
        if (!is_inside(body.rings(), own_place)) {
            continue;
        }
        Hold hold{i, own_place, {}, {}};
        if (body.deforms()) {
            const std::size_t count = body.rings().front().size();
            const std::size_t nearest = body.grip(point).edge;
            const auto reach = static_cast<std::size_t>(held_fraction * double(count)) + 1;
            const double width = static_cast<double>(reach);
            for (std::size_t k = 0; k < 2 * reach + 1; ++k) {
                // The values of a raised cosine add up to 1.
                const double along = static_cast<double>(k) - width;
                const double part = (1.0 + std::cos(std::numbers::pi * along / (width + 1.0))) /
                                    (2.0 * width + 2.0);
                hold.shares.push_back({(nearest + count + k - reach) % count, part});
            }
        }
        held_ = std::move(hold);
        held_->offset = point - this->point(body);
        return true;
    }
    return false;
}

std::vector<Drag::WeightedGrip> Drag::grips(const simulation::Body& body) const {
    std::vector<WeightedGrip> grips;
    if (held_->shares.empty()) {
        grips.push_back({body.grip(simulation::placed(body.pose(), held_->own_place)), 1.0});
    }
    for (const Share& share : held_->shares) {
        simulation::Grip grip;
        grip.point = simulation::placed(body.pose(), body.rings().front()[share.vertex]);
        grip.edge = share.vertex;
        grips.push_back({grip, share.part});
    }
    return grips;
}

Vector2 Drag::point(const simulation::Body& body) const {
    Vector2 sum = held_->offset;
    for (const WeightedGrip& each : grips(body)) {
        sum += each.part * each.grip.point;
    }
    return sum;
}

void Drag::pull(const simulation::Scene& scene) const {
    if (!held_) {
        return;
    }
    simulation::Body& body = *scene.bodies[held_->body];
    const Vector2 way = target_ - point(body);
    const double distance = simulation::length(way);
    const Vector2 direction = distance > 0.0 ? (1.0 / distance) * way : Vector2{1.0, 0.0};
    const std::vector<WeightedGrip> held = grips(body);
    Vector2 velocity;
    double yielding = 0.0;
    for (const WeightedGrip& each : held) {
        velocity += each.part * body.velocity(each.grip);
        yielding += each.part * each.part * body.yielding(each.grip, direction);
    }
    if (yielding <= 0.0) {
        return;
    }
    // Critically damped.
    const double frequency = body.deforms() ? deformable_frequency : rigid_frequency;
    const Vector2 force =
        (1.0 / yielding) * (frequency * frequency * way - 2.0 * frequency * velocity);
    for (const WeightedGrip& each : held) {
        body.push(each.grip, each.part * force);
    }
}

std::optional<Drag::Line> Drag::line(const simulation::Scene& scene) const {
    if (!held_) {
        return std::nullopt;
    }
    return Line{point(*scene.bodies[held_->body]), target_};
}

bool Drag::in_vain(const simulation::Scene& scene) const {
    return held_ && !scene.bodies[held_->body]->movable();
}

}  // namespace nearfield::viewer
