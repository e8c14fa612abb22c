#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>

#include <cstddef>
#include <utility>

namespace nearfield::simulation {
namespace {

/// Integrals over an area of density 1: of 1, of the position and of the squared distance from the
/// origin.
struct Moments {
    double area = 0.0;
    Vector2 first;
    double second = 0.0;
};

/// The moments of the triangles between the origin and each edge, with the sign of the ring's
/// orientation.
Moments moments_of(const Ring& ring, Vector2 origin) {
    Moments sum;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2 a = ring[i] - origin;
        const Vector2 b = ring[(i + 1) % ring.size()] - origin;
        const double twice_area = cross(a, b);
        sum.area += twice_area / 2.0;
        sum.first += (twice_area / 6.0) * (a + b);
        sum.second += twice_area / 12.0 * (dot(a, a) + dot(a, b) + dot(b, b));
    }
    return sum;
}

bool is_inside(Vector2 point, const Ring& ring) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2 a = ring[i];
        const Vector2 b = ring[(i + 1) % ring.size()];
        if ((a.y > point.y) != (b.y > point.y) &&
            point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            inside = !inside;
        }
    }
    return inside;
}

/// Rings that do not cross are nested entirely or not at all.
bool is_hole(std::span<const Ring> rings, std::size_t index) {
    bool hole = false;
    for (std::size_t other = 0; other < rings.size(); ++other) {
        if (other != index && is_inside(rings[index].front(), rings[other])) {
            hole = !hole;
        }
    }
    return hole;
}

}  // namespace

MassProperties mass_properties(std::span<const Ring> rings) {
    // Relative to a vertex: relative to a distant origin of a map, differences would be lost to
    // rounding.
    const Vector2 origin = rings.front().front();
    Moments sum;
    for (std::size_t index = 0; index < rings.size(); ++index) {
        const Moments ring = moments_of(rings[index], origin);
        const double sign = (ring.area < 0.0) == is_hole(rings, index) ? 1.0 : -1.0;
        sum.area += sign * ring.area;
        sum.first += sign * ring.first;
        sum.second += sign * ring.second;
    }
    const Vector2 offset = (1.0 / sum.area) * sum.first;
    return {sum.area, origin + offset, sum.second - sum.area * dot(offset, offset)};
}

RigidBody::RigidBody(std::vector<Ring> rings, const Pose& pose, Freedom freedom, double density)
    : plate_(mass_properties(rings)),
      rings_(std::move(rings)),
      mass_(density * plate_.area),
      inertia_(density * plate_.inertia),
      inverse_mass_(freedom == Freedom::free ? 1.0 / mass_ : 0.0),
      inverse_inertia_(freedom == Freedom::directed ? 0.0 : 1.0 / inertia_),
      position_(placed(pose, plate_.centroid)),
      angle_(pose.angle),
      settled_position_(position_),
      settled_angle_(angle_) {
    for (Ring& ring : rings_) {
        for (Vector2& vertex : ring) {
            vertex -= plate_.centroid;
        }
    }
}

Inventory RigidBody::inventory() const {
    Inventory inventory;
    inventory.mass = inverse_mass_ > 0.0 ? mass_ : 0.0;
    inventory.momentum = inventory.mass * velocity_;
    inventory.kinetic_energy = 0.5 * inventory.mass * dot(velocity_, velocity_);
    if (inverse_inertia_ > 0.0) {
        inventory.angular_momentum = cross(position_, inventory.momentum) + inertia_ * spin_;
        inventory.kinetic_energy += 0.5 * inertia_ * spin_ * spin_;
    }
    return inventory;
}

Vector2 RigidBody::velocity(const Grip& grip) const {
    return velocity_ + spin_ * left_of(grip.point - position_);
}

double RigidBody::yielding(const Grip& grip, Vector2 direction) const {
    const double lever = cross(grip.point - position_, direction);
    return inverse_mass_ + inverse_inertia_ * lever * lever;
}

void RigidBody::push(const Grip& grip, Vector2 force) {
    force_ += force;
    torque_ += cross(grip.point - position_, force);
}

void RigidBody::pull(Vector2 acceleration) {
    force_ += mass_ * acceleration;
}

void RigidBody::slow_down(double drag) {
    force_ -= (drag * mass_) * velocity_;
    torque_ -= drag * inertia_ * spin_;
}

void RigidBody::kick(const Grip& grip, Vector2 impulse) {
    velocity_ += inverse_mass_ * impulse;
    spin_ += inverse_inertia_ * cross(grip.point - position_, impulse);
}

void RigidBody::accelerate(double time) {
    velocity_ += (time * inverse_mass_) * force_;
    spin_ += time * inverse_inertia_ * torque_;
    force_ = {};
    torque_ = 0.0;
}

void RigidBody::move(double time) {
    position_ = settled_position_ + time * velocity_;
    angle_ = settled_angle_ + time * spin_;
}

void RigidBody::settle() {
    settled_position_ = position_;
    settled_angle_ = angle_;
}

void RigidBody::set_motion(Vector2 velocity, double spin) {
    velocity_ = velocity;
    spin_ = spin;
}

}  // namespace nearfield::simulation
