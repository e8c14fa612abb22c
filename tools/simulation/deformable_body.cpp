#include <tools/simulation/deformable_body.hpp>
#include <tools/simulation/rigid_body.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nearfield::simulation {
namespace {

Vector2 mean_of(const Ring& ring) {
    Vector2 sum;
    for (const Vector2& vertex : ring) {
        sum += vertex;
    }
    return (1.0 / static_cast<double>(ring.size())) * sum;
}

double signed_area(const Ring& ring) {
    double twice = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        twice += cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    }
    return twice / 2.0;
}

double perimeter(const Ring& ring) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        sum += length(ring[(i + 1) % ring.size()] - ring[i]);
    }
    return sum;
}

}  // namespace

DeformableBody::DeformableBody(Ring ring, const Softness& softness, std::vector<bool> held)
    : softness_(softness),
      rest_center_(mean_of(ring)),
      rest_area_(std::abs(signed_area(ring))),
      spacing_(perimeter(ring) / static_cast<double>(ring.size())),
      vertex_mass_(softness.density * rest_area_ / static_cast<double>(ring.size())),
      held_(std::move(held)),
      velocities_(ring.size()),
      forces_(ring.size()) {
    if (signed_area(ring) < 0.0) {  // pressure assumes that the outside is on the right
        std::reverse(ring.begin(), ring.end());
        std::reverse(held_.begin(), held_.end());
    }
    held_.resize(ring.size(), false);
    free_ = std::find(held_.begin(), held_.end(), true) == held_.end();
    settled_ = ring;
    for (const Vector2& vertex : ring) {
        rest_.push_back(vertex - rest_center_);
    }
    rings_.push_back(std::move(ring));
}

Vector2 DeformableBody::center() const {
    return mean_of(outline());
}

double DeformableBody::area() const {
    return signed_area(outline());
}

DeformableBody::Frame DeformableBody::frame() const {
    if (!free_) {
        return {rest_center_, 0.0};
    }
    // The rotation that minimises the energy of the springs; with it their total torque is zero.
    const Vector2 center = mean_of(outline());
    const double support = softness_.support * spacing_;
    double along = 0.0;
    double across = 0.0;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        const Vector2 edge = outline()[after(i)] - outline()[i];
        const Vector2 rest_edge = rest_[after(i)] - rest_[i];
        const Vector2 arm = outline()[i] - center;
        along += softness_.tension * dot(rest_edge, edge) + support * dot(rest_[i], arm);
        across += softness_.tension * cross(rest_edge, edge) + support * cross(rest_[i], arm);
    }
    return {center, arc_tangent(across, along)};
}

Inventory DeformableBody::inventory() const {
    Inventory inventory;
    const Pose frame_pose{frame().center, frame().angle};
    double energy = 0.0;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        const Vector2 displacement = outline()[i] - placed(frame_pose, rest_[i]);
        const Vector2 interval =
            outline()[after(i)] - placed(frame_pose, rest_[after(i)]) - displacement;
        energy += 0.5 * softness_.tension * dot(interval, interval) +
                  0.5 * softness_.support * spacing_ * dot(displacement, displacement);
        if (held_[i]) {
            continue;
        }
        const Vector2 momentum = vertex_mass_ * velocities_[i];
        inventory.mass += vertex_mass_;
        inventory.momentum += momentum;
        inventory.angular_momentum += cross(outline()[i], momentum);
        inventory.kinetic_energy += 0.5 * dot(momentum, velocities_[i]);
    }
    const double change = area() - rest_area_;
    inventory.elastic_energy =
        energy + 0.5 * softness_.incompressibility * change * change / rest_area_;
    return inventory;
}

Grip DeformableBody::grip(Vector2 point) const {
    Grip nearest{point};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        const Vector2 from = outline()[i];
        const Vector2 along = outline()[after(i)] - from;
        const double squared = dot(along, along);
        const double part =
            squared > 0.0 ? std::clamp(dot(point - from, along) / squared, 0.0, 1.0) : 0.0;
        const Vector2 aside = point - from - part * along;
        if (dot(aside, aside) < least) {
            least = dot(aside, aside);
            nearest.edge = i;
            nearest.part = part;
        }
    }
    return nearest;
}

Vector2 DeformableBody::velocity(const Grip& grip) const {
    return (1.0 - grip.part) * velocities_[grip.edge] + grip.part * velocities_[after(grip.edge)];
}

double DeformableBody::yielding(const Grip& grip, Vector2 /*direction*/) const {
    const double first = 1.0 - grip.part;
    return first * first * inverse_mass(grip.edge) +
           grip.part * grip.part * inverse_mass(after(grip.edge));
}

void DeformableBody::push(const Grip& grip, Vector2 force) {
    forces_[grip.edge] += (1.0 - grip.part) * force;
    forces_[after(grip.edge)] += grip.part * force;
}

void DeformableBody::pull(Vector2 acceleration) {
    for (Vector2& force : forces_) {
        force += vertex_mass_ * acceleration;
    }
}

void DeformableBody::slow_down(double drag) {
    pull(-drag * mean_of(velocities_));
}

void DeformableBody::kick(const Grip& grip, Vector2 impulse) {
    const std::size_t second = after(grip.edge);
    velocities_[grip.edge] += ((1.0 - grip.part) * inverse_mass(grip.edge)) * impulse;
    velocities_[second] += (grip.part * inverse_mass(second)) * impulse;
}

void DeformableBody::pull_into_shape() {
    const Frame shape = frame();
    const Pose frame_pose{shape.center, shape.angle};
    const double pressure = -softness_.incompressibility * (area() - rest_area_) / rest_area_;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        const std::size_t next = after(i);
        const Vector2 edge = outline()[next] - outline()[i];
        const Vector2 interval = edge - rotated(rest_[next] - rest_[i], shape.angle);
        forces_[i] += softness_.tension * interval;
        forces_[next] -= softness_.tension * interval;
        forces_[i] -=
            (softness_.support * spacing_) * (outline()[i] - placed(frame_pose, rest_[i]));
        // Each end carries half of the pressure on the edge from inside.
        const Vector2 outward = (0.5 * pressure) * -left_of(edge);
        forces_[i] += outward;
        forces_[next] += outward;
    }
}

void DeformableBody::damp() {
    // Damps only the deviation from rigid rotation, so that it takes no angular momentum.
    double turning = 0.0;
    double squared = 0.0;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        const Vector2 edge = outline()[after(i)] - outline()[i];
        turning += cross(edge, velocities_[after(i)] - velocities_[i]);
        squared += dot(edge, edge);
    }
    const double spin = free_ ? turning / squared : 0.0;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        const std::size_t next = after(i);
        const Vector2 edge = outline()[next] - outline()[i];
        const Vector2 force =
            softness_.damping * (velocities_[next] - velocities_[i] - spin * left_of(edge));
        forces_[i] += force;
        forces_[next] -= force;
    }
}

void DeformableBody::accelerate(double time) {
    pull_into_shape();
    damp();
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        velocities_[i] += (time * inverse_mass(i)) * forces_[i];
        forces_[i] = {};
    }
}

void DeformableBody::move(double time) {
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        rings_.front()[i] = settled_[i] + time * velocities_[i];
    }
}

void DeformableBody::settle() {
    settled_ = outline();
}

void DeformableBody::disturb(std::size_t vertex, Vector2 displacement, Vector2 velocity) {
    rings_.front()[vertex] += displacement;
    settled_[vertex] = rings_.front()[vertex];
    velocities_[vertex] = velocity;
}

}  // namespace nearfield::simulation
