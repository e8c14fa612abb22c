#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>

#include <utility>

namespace nearfield::simulation {

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
