#pragma once

#include <nearfield/context.hpp>

#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/world.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace nearfield::test {

/// One context for the whole program.
[[nodiscard]] Context& simulation_context();

/// Sums over all bodies.
[[nodiscard]] inline simulation::Inventory inventory_of(const simulation::Scene& scene) {
    simulation::Inventory sum;
    for (const auto& body : scene.bodies) {
        const simulation::Inventory inventory = body->inventory();
        sum.mass += inventory.mass;
        sum.momentum = simulation::operator+(sum.momentum, inventory.momentum);
        sum.angular_momentum += inventory.angular_momentum;
        sum.kinetic_energy += inventory.kinetic_energy;
        sum.elastic_energy += inventory.elastic_energy;
    }
    return sum;
}

/// The maximum depth of a point in another body if the springs of the penalty response have at most
/// the energy `energy`. From a deep point, the boundary leaves the other body in two directions;
/// the depth decreases at most as fast as the boundary's length grows, so each direction holds at
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
        ring.push_back(simulation::polar(i % 2 == 0 ? 1.0 : 0.5, 0.6283185307179586 * i));
    }
    return ring;
}

/// Adds a rigid body and returns it.
inline simulation::RigidBody& add_body(simulation::Scene& scene, Ring ring, const Pose& pose,
                                       simulation::Freedom freedom = simulation::Freedom::free) {
    auto body =
        std::make_unique<simulation::RigidBody>(std::vector<Ring>{std::move(ring)}, pose, freedom);
    simulation::RigidBody& added = *body;
    scene.bodies.push_back(std::move(body));
    scene.looks.push_back({});
    return added;
}

/// Two stars that will collide off centre, with nothing else around.
[[nodiscard]] inline simulation::Scene meeting_stars() {
    simulation::Scene scene;
    scene.name = "stars";
    add_body(scene, star_ring(), {{-1.5, 0.0}, 0.1}).set_motion({1.0, 0.1}, 0.3);
    add_body(scene, star_ring(), {{1.5, 0.45}, 0.7}).set_motion({-1.2, 0.0}, -0.2);
    scene.touch = {2000.0, 20.0, 0.2, 0.5};
    return scene;
}

/// Boxes stacked with small gaps above a floor.
[[nodiscard]] inline simulation::Scene stack_of_boxes(int boxes) {
    simulation::Scene scene;
    scene.name = "stack";
    add_body(scene, box(8.0, 1.0), {{0.0, -0.5}}, simulation::Freedom::directed);
    for (int i = 0; i < boxes; ++i) {
        add_body(scene, box(1.0, 1.0), {{0.03 * (i % 2), 0.52 + 1.02 * i}});
    }
    scene.surroundings.gravity = {0.0, -5.0};
    scene.touch = {4000.0, 60.0, 0.5, 0.1};
    return scene;
}

}  // namespace nearfield::test
