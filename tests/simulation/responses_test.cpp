#include "simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace nearfield::test {

Context& simulation_context() {
    // Destroyed before Vulkan is unloaded, so not left to the program's end.
    struct Shared : testing::Environment {
        void TearDown() override { context.reset(); }
        std::optional<Context> context;
    };
    static Shared* const shared = [] {
        auto* made = new Shared;
        Settings settings;
        settings.pipelines_on_demand = true;
        Expected<Context> context = Context::create_headless({}, settings);
        if (!context) {
            throw std::runtime_error(context.error().text());
        }
        made->context.emplace(std::move(*context));
        testing::AddGlobalTestEnvironment(made);
        return made;
    }();
    return *shared->context;
}

namespace {

using namespace simulation;

simulation::World world_of(Scene scene, Response response, Technique technique = Technique::cpu) {
    return {simulation_context(), std::move(scene), response, technique};
}

TEST(Penalty, ACollisionKeepsMomentaAndTakesEnergy) {
    simulation::World world = world_of(meeting_stars(), Response::penalty);
    const Inventory before = inventory_of(world.scene());
    const Scene& scene = world.scene();
    // The depth at which the springs hold all of the energy, plus the motion in the step that
    // detects it.
    const double step = scene.frame_time / scene.steps;
    const double deepest =
        deepest_by_energy(before.kinetic_energy, scene.touch.stiffness) + 2.5 * step;
    // A step of a spring conserves its energy to the fraction (frequency * step)^2 / 2: less than
    // 0.4 of boundary is inside, of which each body contributes half, against a mass of 0.7.
    const double squared_frequency = 0.5 * scene.touch.stiffness * 0.4 / 0.7;
    const double by_step = 0.5 * squared_frequency * step * step * before.kinetic_energy;
    double last = before.kinetic_energy;
    bool met = false;
    for (int frame = 0; frame < 240; ++frame) {
        const FrameReport report = world.advance();
        met = met || report.contacts > 0;
        EXPECT_LT(report.energies.total(), last + by_step) << frame;
        last = std::min(last, report.energies.total());
        EXPECT_LT(report.worst_penetration, deepest);
    }
    const Inventory after = inventory_of(world.scene());
    EXPECT_TRUE(met);
    EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-10);
    EXPECT_NEAR(after.momentum.y, before.momentum.y, 1e-10);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 1e-10);
    EXPECT_LT(last, before.kinetic_energy - by_step);
    EXPECT_TRUE(world.proximity().overlaps().empty()) << "they part again";
}

TEST(Penalty, WithoutDampingAndFrictionTheEnergyComesBack) {
    simulation::Scene scene = meeting_stars();
    scene.touch.damping = 0.0;
    scene.touch.friction = 0.0;
    scene.steps = 16;
    // Steps update velocities first, so they conserve an energy that differs from the true one by a
    // fraction of frequency * step / 2 while springs are compressed (as above, and the rotation of
    // each body yields as much again). Afterwards this difference vanishes except where samples
    // came and went between steps, with either sign; so the fraction is a bound.
    const double step = scene.frame_time / scene.steps;
    const double part = 0.5 * step * std::sqrt(2.0 * 0.5 * scene.touch.stiffness * 0.4 / 0.7);
    simulation::World world = world_of(std::move(scene), Response::penalty);
    const double before = inventory_of(world.scene()).kinetic_energy;
    double stored = 0.0;
    for (int frame = 0; frame < 240; ++frame) {
        stored = std::max(stored, world.advance().energies.contact);
    }
    EXPECT_GT(stored, 5.0 * part * before) << "else there was nothing to come back";
    EXPECT_NEAR(inventory_of(world.scene()).kinetic_energy, before, part * before);
}

TEST(Penalty, AStackComesToRestWhereItStands) {
    constexpr int boxes = 4;
    simulation::World world = world_of(stack_of_boxes(boxes), Response::penalty);
    const Scene& scene = world.scene();
    simulation::FrameReport report;
    for (int frame = 0; frame < 360; ++frame) {
        report = world.advance();
    }
    // At rest: nothing moves by a tenth of the tolerance in a second.
    const double slow = 0.1 * scene.tolerance;
    EXPECT_LT(report.energies.kinetic, 0.5 * boxes * slow * slow);
    // Boxes of mass 1 and width 1: the weight of all boxes above presses each into the one below,
    // and the springs of both bodies, half each, act on the full width. Samples at the ends change
    // the width by a cell, and a box offset by 0.03 from the one below has that much less.
    const double per_box = -scene.surroundings.gravity.y / scene.touch.stiffness;
    const double part = 0.03 + scene.tolerance * std::sqrt(2.0);
    double sunk = 0.0;
    double slack = 0.0;
    for (int i = 0; i < boxes; ++i) {
        sunk += (boxes - i) * per_box;
        slack += part * (boxes - i) * per_box;
        const Pose pose = scene.bodies[static_cast<std::size_t>(i) + 1]->pose();
        EXPECT_NEAR(pose.translation.y, 0.5 + i - sunk, slack) << i;
        // The boxes above are offset by 0.03 and tilt it: their torque divided by the springs'
        // stiffness.
        EXPECT_NEAR(pose.angle, 0.0, 2.0 * boxes * 0.03 * per_box * 12.0) << i;
    }
    const double lean = 0.5 * 2.0 * boxes * 0.03 * per_box * 12.0;
    EXPECT_LT(report.worst_penetration, boxes * per_box * (1.0 + part) + lean);
}

TEST(Backtracking, EqualBoxesExchangeTheirSpeedsByRestitution) {
    for (const double restitution : {1.0, 0.5, 0.0}) {
        simulation::Scene scene;
        simulation::RigidBody& left = add_body(scene, box(1.0, 1.0), {{-1.0, 0.0}});
        simulation::RigidBody& right = add_body(scene, box(1.0, 1.0), {{1.0, 0.0}});
        left.set_motion({1.0, 0.0}, 0.0);
        right.set_motion({-1.0, 0.0}, 0.0);
        scene.touch.restitution = restitution;
        simulation::World world = world_of(std::move(scene), Response::backtracking);
        std::size_t events = 0;
        for (int frame = 0; frame < 60; ++frame) {
            events += world.advance().events;
        }
        EXPECT_GT(events, 0U);
        // Bodies that would part more slowly are separated to half the tolerance, by a twentieth of
        // the missing distance per step, which is at most a quarter of the tolerance.
        const double step = world.scene().frame_time / world.scene().steps;
        const double opening = 0.5 * 0.05 * 0.25 * world.scene().tolerance / step;
        const double tolerance = restitution > 0.0 ? 1e-9 : opening;
        EXPECT_NEAR(right.velocity().x, restitution, tolerance) << restitution;
        EXPECT_NEAR(left.velocity().x, -restitution, tolerance) << restitution;
        EXPECT_NEAR(left.spin(), 0.0, 1e-9);
    }
}

TEST(Backtracking, ACollisionKeepsMomentaAndNeverPenetrates) {
    simulation::World world = world_of(meeting_stars(), Response::backtracking);
    const Inventory before = inventory_of(world.scene());
    for (int frame = 0; frame < 240; ++frame) {
        EXPECT_EQ(world.advance().worst_penetration, 0.0) << frame;
    }
    const Inventory after = inventory_of(world.scene());
    EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-10);
    EXPECT_NEAR(after.momentum.y, before.momentum.y, 1e-10);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 1e-10);
    EXPECT_LT(after.kinetic_energy, before.kinetic_energy);
}

TEST(Backtracking, AStackComesToRestWhereItStandsWithoutPenetration) {
    constexpr int boxes = 3;
    simulation::World world = world_of(stack_of_boxes(boxes), Response::backtracking);
    const Scene& scene = world.scene();
    simulation::FrameReport report;
    for (int frame = 0; frame < 300; ++frame) {
        report = world.advance();
        EXPECT_EQ(report.worst_penetration, 0.0) << frame;
    }
    // The remaining motion is the separation of contacts, each by a twentieth of a quarter of the
    // tolerance per step, and the fall in a step that closes them.
    const double step = scene.frame_time / scene.steps;
    const double slow =
        boxes * 0.05 * 0.25 * scene.tolerance / step - scene.surroundings.gravity.y * step;
    EXPECT_LT(report.energies.kinetic, 0.5 * boxes * slow * slow);
    double low = 0.0;
    double high = 0.0;
    for (int i = 0; i < boxes; ++i) {
        // Each contact keeps a quarter of the tolerance, and acts within two tolerances.
        low += 0.25 * scene.tolerance;
        high += 2.0 * scene.tolerance;
        const Pose pose = scene.bodies[static_cast<std::size_t>(i) + 1]->pose();
        EXPECT_GE(pose.translation.y, 0.5 + i + low) << i;
        EXPECT_LE(pose.translation.y, 0.5 + i + high) << i;
        // The tilt of a box with one corner low and the other high.
        EXPECT_NEAR(pose.angle, 0.0, high - low) << i;
    }
}

TEST(Backtracking, NothingPassesThroughAnotherBetweenTwoSteps) {
    // In one step it moves by twenty times the thickness of the wall, and it overlaps neither side
    // of the wall at the ends of that step.
    simulation::Scene scene;
    add_body(scene, box(0.05, 6.0), {}, Freedom::directed);
    simulation::RigidBody& fast = add_body(scene, box(0.2, 0.2), {{-0.53, 0.0}});
    fast.set_motion({240.0, 0.0}, 0.0);
    scene.touch.restitution = 0.5;
    simulation::World world = world_of(std::move(scene), Response::backtracking);
    const FrameReport report = world.advance();
    EXPECT_EQ(report.events, 1U);
    EXPECT_LT(fast.center().x, 0.0);
    EXPECT_NEAR(fast.velocity().x, -120.0, 1e-9);
}

TEST(Backtracking, RefusesASceneThatStartsWithATouch) {
    simulation::Scene scene;
    add_body(scene, box(1.0, 1.0), {});
    add_body(scene, box(1.0, 1.0), {{1.0, 0.0}});
    EXPECT_THROW(world_of(std::move(scene), Response::backtracking), std::invalid_argument);
}

TEST(Backtracking, RefusesASceneThatStartsWithAnOverlap) {
    simulation::Scene scene;
    add_body(scene, box(1.0, 1.0), {});
    add_body(scene, box(1.0, 1.0), {{0.5, 0.0}});
    EXPECT_THROW(world_of(std::move(scene), Response::backtracking), std::invalid_argument);
}

}  // namespace
}  // namespace nearfield::test
