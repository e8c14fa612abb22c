#include "simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace nearfield::test {
namespace {

using namespace simulation;

TEST(Spin, IsSlowedByDragAsVelocityIs) {
    simulation::RigidBody body({star_ring()}, {{3.0, -2.0}, 0.4});
    body.set_motion({2.0, -1.0}, 4.0);
    constexpr double drag = 0.8;
    constexpr double time = 0.001;
    for (int i = 0; i < 1000; ++i) {
        body.slow_down(drag);
        body.accelerate(time);
        body.move(time);
        body.settle();
    }
    // Both fall by the same part in every step.
    const double left = std::pow(1.0 - drag * time, 1000);
    EXPECT_NEAR(body.spin(), 4.0 * left, 1e-9);
    const Inventory inventory = body.inventory();
    EXPECT_NEAR(inventory.momentum.x, 2.0 * left * inventory.mass, 1e-9);
    EXPECT_NEAR(inventory.momentum.y, -1.0 * left * inventory.mass, 1e-9);
}

TEST(Spin, AloneBringsABarIntoReachOfWhatBacktrackingSees) {
    // Nothing moves but a long bar that turns about its middle, past a small box beside its end, by
    // more than the box is wide in a step.
    simulation::Scene scene;
    scene.name = "bar";
    scene.steps = 1;
    add_body(scene, box(8.0, 0.1), {{0.0, 0.0}, 0.0}).set_motion({}, 0.9 / scene.frame_time);
    const simulation::RigidBody& hit = add_body(scene, box(0.2, 0.2), {{3.0, 1.2}, 0.0});
    simulation::World world(simulation_context(), std::move(scene), Response::backtracking,
                            Technique::cpu);
    const FrameReport report = world.advance();
    EXPECT_GT(report.events, 0U) << "the bar went through the box";
    EXPECT_GT(report.contacts, 0U);
    EXPECT_GT(hit.inventory().kinetic_energy, 0.0);
    EXPECT_TRUE(world.proximity().overlaps().empty());
}

}  // namespace
}  // namespace nearfield::test
