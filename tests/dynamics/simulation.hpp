#pragma once

#include <nearfield/context.hpp>

#include <tools/dynamics/plane.hpp>
#include <tools/dynamics/rigid_body.hpp>
#include <tools/dynamics/world.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace nearfield::test {

/// One for the whole program.
[[nodiscard]] Context& simulation_context();

/// Sums over all bodies.
[[nodiscard]] inline dynamics::Inventory inventory_of(const dynamics::Scene& scene) {
    dynamics::Inventory sum;
    for (const auto& body : scene.bodies) {
        const dynamics::Inventory inventory = body->inventory();
        sum.mass += inventory.mass;
        sum.momentum = dynamics::operator+(sum.momentum, inventory.momentum);
        sum.angular_momentum += inventory.angular_momentum;
        sum.kinetic_energy += inventory.kinetic_energy;
        sum.elastic_energy += inventory.elastic_energy;
    }
    return sum;
}

/// No point can be deeper in another body than this, where the springs of the penalty response have
/// no more energy than `energy`. From a point that is deep, the boundary goes out of the other body
/// in two directions; the depth falls no faster than the boundary is long, so either way holds at
/// least the integral of stiffness / 4 * s^2 from 0 to the depth.
[[nodiscard]] inline double deepest_by_energy(double energy, double stiffness) {
    return std::cbrt(6.0 * energy / stiffness);
}

[[nodiscard]] inline Ring box(double width, double height) {
    return {{-width / 2.0, -height / 2.0},
            {width / 2.0, -height / 2.0},
            {width / 2.0, height / 2.0},
            {-width / 2.0, height / 2.0}};
}

/// A non-convex ring of five points.
[[nodiscard]] inline Ring star_ring() {
    Ring ring;
    for (int i = 0; i < 10; ++i) {
        ring.push_back(dynamics::polar(i % 2 == 0 ? 1.0 : 0.5, 0.6283185307179586 * i));
    }
    return ring;
}

/// Adds a rigid body and returns it.
inline dynamics::RigidBody& add_body(dynamics::Scene& scene, Ring ring, const Pose& pose,
                                     dynamics::Freedom freedom = dynamics::Freedom::free) {
    auto body =
        std::make_unique<dynamics::RigidBody>(std::vector<Ring>{std::move(ring)}, pose, freedom);
    dynamics::RigidBody& added = *body;
    scene.bodies.push_back(std::move(body));
    scene.looks.push_back({});
    return added;
}

/// Two stars that will meet off centre, without anything else about.
[[nodiscard]] inline dynamics::Scene meeting_stars() {
    dynamics::Scene scene;
    scene.name = "stars";
    add_body(scene, star_ring(), {{-1.5, 0.0}, 0.1}).set_motion({1.0, 0.1}, 0.3);
    add_body(scene, star_ring(), {{1.5, 0.45}, 0.7}).set_motion({-1.2, 0.0}, -0.2);
    scene.touch = {2000.0, 20.0, 0.2, 0.5};
    return scene;
}

/// Boxes one over the other, a little apart, over a floor.
[[nodiscard]] inline dynamics::Scene stack_of_boxes(int boxes) {
    dynamics::Scene scene;
    scene.name = "stack";
    add_body(scene, box(8.0, 1.0), {{0.0, -0.5}}, dynamics::Freedom::directed);
    for (int i = 0; i < boxes; ++i) {
        add_body(scene, box(1.0, 1.0), {{0.03 * (i % 2), 0.52 + 1.02 * i}});
    }
    scene.surroundings.gravity = {0.0, -5.0};
    scene.touch = {4000.0, 60.0, 0.5, 0.1};
    return scene;
}

}  // namespace nearfield::test
