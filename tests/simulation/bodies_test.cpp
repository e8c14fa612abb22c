#include "simulation.hpp"

#include <gtest/gtest.h>
#include <tools/simulation/deformable_body.hpp>

#include <cmath>

namespace nearfield::test {
namespace {

using namespace simulation;

Ring rounded(std::size_t vertices) {
    Ring ring;
    for (std::size_t i = 0; i < vertices; ++i) {
        const double turn =
            6.283185307179586 * static_cast<double>(i) / static_cast<double>(vertices);
        ring.push_back({2.0 + 1.5 * std::cos(turn), -1.0 + std::sin(turn)});
    }
    return ring;
}

void let_go(simulation::Body& body, int steps, double time) {
    for (int i = 0; i < steps; ++i) {
        body.accelerate(time);
        body.move(time);
        body.settle();
    }
}

TEST(Bodies, AnImpulseGivesARigidBodyItsMomentumAndAngularMomentum) {
    simulation::RigidBody body({star_ring()}, {{3.0, -2.0}, 0.4});
    body.set_motion({0.5, 1.0}, -2.0);
    const Inventory before = body.inventory();
    const Vector2 point{3.5, -1.2};
    const Vector2 impulse{0.3, -0.7};
    body.kick(body.grip(point), impulse);
    const Inventory after = body.inventory();
    EXPECT_NEAR(after.momentum.x - before.momentum.x, impulse.x, 1e-12);
    EXPECT_NEAR(after.momentum.y - before.momentum.y, impulse.y, 1e-12);
    EXPECT_NEAR(after.angular_momentum - before.angular_momentum, simulation::cross(point, impulse),
                1e-12);
}

TEST(Bodies, AForceForATimeIsAnImpulseAndWhatItYieldsIsWhatYieldingSays) {
    simulation::RigidBody pushed({star_ring()}, {{3.0, -2.0}, 0.4});
    simulation::RigidBody kicked({star_ring()}, {{3.0, -2.0}, 0.4});
    const Vector2 direction = simulation::polar(1.0, 0.3);
    const Grip grip = pushed.grip({3.8, -2.1});
    const double yielding = pushed.yielding(grip, direction);
    pushed.push(grip, 8.0 * direction);
    pushed.accelerate(0.25);
    kicked.kick(grip, 2.0 * direction);
    EXPECT_NEAR(pushed.spin(), kicked.spin(), 1e-12);
    EXPECT_NEAR(simulation::dot(pushed.velocity(grip), direction), 2.0 * yielding, 1e-12);
}

TEST(Bodies, WhatIsOnAShaftTurnsAndWhatIsDirectedDoesNeither) {
    simulation::RigidBody wheel({star_ring()}, {}, Freedom::turning);
    simulation::RigidBody motor({star_ring()}, {}, Freedom::directed);
    motor.set_motion({}, 1.5);
    for (simulation::RigidBody* body : {&wheel, &motor}) {
        body->push(body->grip({0.9, 0.0}), {1.0, 2.0});
        body->accelerate(1.0);
    }
    EXPECT_EQ(wheel.velocity(), Vector2{});
    EXPECT_NEAR(wheel.spin(), 1.8 / wheel.inertia(), 1e-12);
    EXPECT_EQ(motor.spin(), 1.5);
    EXPECT_TRUE(wheel.movable());
    EXPECT_FALSE(motor.movable());
}

// The allowed momentum error after thousands of steps: each adds a few rounding errors of numbers
// below 10.
constexpr double lost_by_rounding = 1e-10;

/// The fraction of the energy by which a time step makes the measured energy oscillate: for an
/// oscillation, steps that update velocities first conserve E - time / 2 * velocity * force, whose
/// last term is at most the fraction frequency * time / 2 of E. In the fastest oscillation,
/// neighbours move in opposite directions, and the pressure is taken as in phase with it.
double hidden_by_steps(const DeformableBody& body, const Softness& softness, double time) {
    const auto count = static_cast<double>(body.rest().size());
    double perimeter = 0.0;
    for (std::size_t i = 0; i < body.rest().size(); ++i) {
        perimeter += simulation::length(body.rest()[(i + 1) % body.rest().size()] - body.rest()[i]);
    }
    const double spacing = perimeter / count;
    const double stiffness =
        4.0 * softness.tension + softness.support * spacing +
        softness.incompressibility / body.rest_area() * spacing * spacing * count;
    const double mass = softness.density * body.rest_area() / count;
    return 0.5 * time * std::sqrt(stiffness / mass);
}

TEST(Bodies, ADisturbedDeformableBodyKeepsItsMomentaAndItsEnergy) {
    constexpr double time = 1.0 / 1000.0;
    const Softness softness{1.0, 8.0, 2.0, 30.0, 0.0};
    simulation::DeformableBody body(rounded(60), softness);
    for (std::size_t i = 0; i < 8; ++i) {
        body.disturb(i, {0.1, 0.05}, {0.6, -0.4 + 0.2 * static_cast<double>(i)});
    }
    const Inventory before = body.inventory();
    const double energy = before.kinetic_energy + before.elastic_energy;
    const double hidden = hidden_by_steps(body, softness, time) * energy;
    // The change of area if all of the energy were in the pressure.
    const double change =
        std::sqrt(2.0 * (energy + hidden) * body.rest_area() / softness.incompressibility);
    for (int i = 0; i < 40; ++i) {
        let_go(body, 100, time);
        const Inventory now = body.inventory();
        EXPECT_NEAR(now.kinetic_energy + now.elastic_energy, energy, hidden) << i;
        EXPECT_NEAR(body.area(), body.rest_area(), change) << i;
    }
    const Inventory after = body.inventory();
    EXPECT_NEAR(after.momentum.x, before.momentum.x, lost_by_rounding);
    EXPECT_NEAR(after.momentum.y, before.momentum.y, lost_by_rounding);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, lost_by_rounding);
}

TEST(Bodies, DampingTakesTheEnergyOfADeformableBodyButNotItsMomenta) {
    constexpr double time = 1.0 / 1000.0;
    const Softness softness{1.0, 8.0, 2.0, 30.0, 0.2};
    simulation::DeformableBody body(rounded(60), softness);
    for (std::size_t i = 0; i < 60; ++i) {
        body.disturb(i, {}, {i < 8 ? 3.0 : 0.0, 0.2});
    }
    const Inventory before = body.inventory();
    const double start = before.kinetic_energy + before.elastic_energy;
    // The kinetic energy of rigid motion, which is conserved: rotation is about the centre, with
    // the moment of inertia of the ring of masses.
    const Vector2 velocity = (1.0 / before.mass) * before.momentum;
    const double turning =
        before.angular_momentum - simulation::cross(body.center(), before.momentum);
    double inertia = 0.0;
    for (const Vector2& vertex : body.rest()) {
        inertia += before.mass / 60.0 * simulation::dot(vertex, vertex);
    }
    const double rigid =
        0.5 * before.mass * simulation::dot(velocity, velocity) + 0.5 * turning * turning / inertia;
    double last = start;
    for (int i = 0; i < 20; ++i) {
        let_go(body, 400, time);
        const Inventory now = body.inventory();
        const double energy = now.kinetic_energy + now.elastic_energy;
        EXPECT_LT(energy, last * (1.0 + hidden_by_steps(body, softness, time))) << i;
        last = energy;
    }
    const Inventory after = body.inventory();
    EXPECT_NEAR(after.momentum.x, before.momentum.x, lost_by_rounding);
    EXPECT_NEAR(after.momentum.y, before.momentum.y, lost_by_rounding);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, lost_by_rounding);
    // A wave of n periods around the ring decays by damping / mass * (2 pi n / 60)^2 of its energy:
    // in these 8 seconds, waves with three or more periods decay to less than a seventh. Of a push
    // on 8 vertices of 60, less than half is in the two longest waves.
    EXPECT_LT(last - rigid, (0.5 + 0.5 / 7.0) * (start - rigid));
}

TEST(Bodies, ADeformableBodyHasNoEnergyWhereverItIsTurned) {
    simulation::DeformableBody body(rounded(40), {});
    const Ring ring = body.outline();
    for (std::size_t i = 0; i < ring.size(); ++i) {
        body.disturb(i, simulation::rotated(ring[i], 2.0) + Vector2{5.0, 5.0} - ring[i], {});
    }
    EXPECT_NEAR(body.inventory().elastic_energy, 0.0, 1e-20);
    let_go(body, 100, 0.01);
    EXPECT_NEAR(body.inventory().kinetic_energy, 0.0, 1e-20);
}

TEST(Bodies, HeldVerticesStayWhateverPushes) {
    std::vector<bool> held(40, false);
    held[3] = held[17] = true;
    simulation::DeformableBody body(rounded(40), {}, held);
    const Ring before = body.outline();
    for (int i = 0; i < 50; ++i) {
        body.pull({1.0, -2.0});
        let_go(body, 1, 0.01);
    }
    EXPECT_EQ(body.outline()[3], before[3]);
    EXPECT_EQ(body.outline()[17], before[17]);
    EXPECT_NE(body.outline()[10], before[10]);
}

}  // namespace
}  // namespace nearfield::test
