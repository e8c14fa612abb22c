#include "simulation.hpp"

#include <gtest/gtest.h>
#include <tools/dynamics/deformable_body.hpp>

#include <cmath>

namespace nearfield::test {
namespace {

using namespace dynamics;

Ring rounded(std::size_t vertices) {
    Ring ring;
    for (std::size_t i = 0; i < vertices; ++i) {
        const double turn =
            6.283185307179586 * static_cast<double>(i) / static_cast<double>(vertices);
        ring.push_back({2.0 + 1.5 * std::cos(turn), -1.0 + std::sin(turn)});
    }
    return ring;
}

void let_go(Body& body, int steps, double time) {
    for (int i = 0; i < steps; ++i) {
        body.accelerate(time);
        body.move(time);
        body.settle();
    }
}

TEST(Bodies, AnImpulseGivesARigidBodyItsMomentumAndAngularMomentum) {
    RigidBody body({star_ring()}, {{3.0, -2.0}, 0.4});
    body.set_motion({0.5, 1.0}, -2.0);
    const Inventory before = body.inventory();
    const Vector2 point{3.5, -1.2};
    const Vector2 impulse{0.3, -0.7};
    body.kick(body.grip(point), impulse);
    const Inventory after = body.inventory();
    EXPECT_NEAR(after.momentum.x - before.momentum.x, impulse.x, 1e-12);
    EXPECT_NEAR(after.momentum.y - before.momentum.y, impulse.y, 1e-12);
    EXPECT_NEAR(after.angular_momentum - before.angular_momentum, cross(point, impulse), 1e-12);
}

TEST(Bodies, AForceForATimeIsAnImpulseAndWhatItYieldsIsWhatYieldingSays) {
    RigidBody pushed({star_ring()}, {{3.0, -2.0}, 0.4});
    RigidBody kicked({star_ring()}, {{3.0, -2.0}, 0.4});
    const Vector2 direction = polar(1.0, 0.3);
    const Grip grip = pushed.grip({3.8, -2.1});
    const double yielding = pushed.yielding(grip, direction);
    pushed.push(grip, 8.0 * direction);
    pushed.accelerate(0.25);
    kicked.kick(grip, 2.0 * direction);
    EXPECT_NEAR(pushed.spin(), kicked.spin(), 1e-12);
    EXPECT_NEAR(dot(pushed.velocity(grip), direction), 2.0 * yielding, 1e-12);
}

TEST(Bodies, WhatIsOnAShaftTurnsAndWhatIsDirectedDoesNeither) {
    RigidBody wheel({star_ring()}, {}, Freedom::turning);
    RigidBody motor({star_ring()}, {}, Freedom::directed);
    motor.set_motion({}, 1.5);
    for (RigidBody* body : {&wheel, &motor}) {
        body->push(body->grip({0.9, 0.0}), {1.0, 2.0});
        body->accelerate(1.0);
    }
    EXPECT_EQ(wheel.velocity(), Vector2{});
    EXPECT_NEAR(wheel.spin(), 1.8 / wheel.inertia(), 1e-12);
    EXPECT_EQ(motor.spin(), 1.5);
    EXPECT_TRUE(wheel.movable());
    EXPECT_FALSE(motor.movable());
}

TEST(Bodies, ADisturbedDeformableBodyKeepsItsMomentaAndItsEnergy) {
    DeformableBody body(rounded(60), {1.0, 8.0, 2.0, 30.0, 0.0});
    for (std::size_t i = 0; i < 8; ++i) {
        body.disturb(i, {0.1, 0.05}, {0.6, -0.4 + 0.2 * static_cast<double>(i)});
    }
    const Inventory before = body.inventory();
    let_go(body, 4000, 1.0 / 1000.0);
    const Inventory after = body.inventory();
    EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-9);
    EXPECT_NEAR(after.momentum.y, before.momentum.y, 1e-9);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 2e-3);
    const double energy = before.kinetic_energy + before.elastic_energy;
    EXPECT_NEAR(after.kinetic_energy + after.elastic_energy, energy, 0.03 * energy);
    EXPECT_NEAR(body.area(), body.rest_area(), 0.05 * body.rest_area());
}

TEST(Bodies, DampingTakesTheEnergyOfADeformableBodyButNotItsMomenta) {
    DeformableBody body(rounded(60), {1.0, 8.0, 2.0, 30.0, 0.2});
    for (std::size_t i = 0; i < 60; ++i) {
        body.disturb(i, {}, {i < 8 ? 3.0 : 0.0, 0.2});
    }
    const Inventory before = body.inventory();
    double last = before.kinetic_energy + before.elastic_energy;
    for (int i = 0; i < 20; ++i) {
        let_go(body, 400, 1.0 / 1000.0);
        const Inventory now = body.inventory();
        EXPECT_LT(now.kinetic_energy + now.elastic_energy, 1.001 * last) << i;
        last = now.kinetic_energy + now.elastic_energy;
    }
    const Inventory after = body.inventory();
    EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-9);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 2e-3);
    EXPECT_LT(after.kinetic_energy + after.elastic_energy, 0.6 * before.kinetic_energy);
}

TEST(Bodies, ADeformableBodyHasNoEnergyWhereverItIsTurned) {
    DeformableBody body(rounded(40), {});
    const Ring ring = body.outline();
    for (std::size_t i = 0; i < ring.size(); ++i) {
        body.disturb(i, rotated(ring[i], 2.0) + Vector2{5.0, 5.0} - ring[i], {});
    }
    EXPECT_NEAR(body.inventory().elastic_energy, 0.0, 1e-20);
    let_go(body, 100, 0.01);
    EXPECT_NEAR(body.inventory().kinetic_energy, 0.0, 1e-20);
}

TEST(Bodies, HeldVerticesStayWhateverPushes) {
    std::vector<bool> held(40, false);
    held[3] = held[17] = true;
    DeformableBody body(rounded(40), {}, held);
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
