#include "simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace nearfield::test {

Context& simulation_context() {
    // Taken down before Vulkan is unloaded, so not left to the program's end.
    struct Shared : testing::Environment {
        void TearDown() override { context.reset(); }
        std::optional<Context> context;
    };
    static Shared* const shared = [] {
        auto* made = new Shared;
        Expected<Context> context = Context::create_headless();
        if (!context.ok()) {
            throw std::runtime_error(context.status().text());
        }
        made->context.emplace(std::move(*context));
        testing::AddGlobalTestEnvironment(made);
        return made;
    }();
    return *shared->context;
}

namespace {

using namespace dynamics;

World world_of(Scene scene, Response response, Technique technique = Technique::cpu) {
    return {simulation_context(), std::move(scene), response, technique};
}

TEST(Penalty, ACollisionKeepsMomentaAndTakesEnergy) {
    World world = world_of(meeting_stars(), Response::penalty);
    const Inventory before = inventory_of(world.scene());
    double last = before.kinetic_energy;
    bool met = false;
    for (int frame = 0; frame < 240; ++frame) {
        const FrameReport report = world.advance();
        met = met || report.contacts > 0;
        // The energy stored in the springs is that of samples, which come and go cell by cell.
        EXPECT_LT(report.energies.total(), last + 0.004 * before.kinetic_energy) << frame;
        last = std::min(last, report.energies.total());
        EXPECT_LT(report.worst_penetration, 0.2);
    }
    const Inventory after = inventory_of(world.scene());
    EXPECT_TRUE(met);
    EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-10);
    EXPECT_NEAR(after.momentum.y, before.momentum.y, 1e-10);
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 1e-10);
    EXPECT_LT(last, 0.95 * before.kinetic_energy);
    EXPECT_TRUE(world.proximity().overlaps().empty()) << "they part again";
}

TEST(Penalty, WithoutDampingAndFrictionTheEnergyComesBack) {
    Scene scene = meeting_stars();
    scene.touch.damping = 0.0;
    scene.touch.friction = 0.0;
    scene.steps = 16;
    World world = world_of(std::move(scene), Response::penalty);
    const double before = inventory_of(world.scene()).kinetic_energy;
    double stored = 0.0;
    for (int frame = 0; frame < 240; ++frame) {
        stored = std::max(stored, world.advance().energies.contact);
    }
    EXPECT_GT(stored, 0.1 * before);
    EXPECT_NEAR(inventory_of(world.scene()).kinetic_energy, before, 0.02 * before);
}

TEST(Penalty, AStackComesToRestWhereItStands) {
    World world = world_of(stack_of_boxes(4), Response::penalty);
    FrameReport report;
    for (int frame = 0; frame < 360; ++frame) {
        report = world.advance();
    }
    EXPECT_LT(report.energies.kinetic, 1e-6);
    EXPECT_LT(report.worst_penetration, 0.02);
    for (std::size_t i = 1; i < 5; ++i) {
        const Pose pose = world.scene().bodies[i]->pose();
        EXPECT_NEAR(pose.translation.y, 0.5 + 1.0 * static_cast<double>(i - 1), 0.05) << i;
        EXPECT_NEAR(pose.angle, 0.0, 0.02) << i;
    }
}

TEST(Penalty, IsTheSameOnEveryRunAndWithEveryTechnique) {
    const auto run = [](Technique technique) {
        World world = world_of(meeting_stars(), Response::penalty, technique);
        std::vector<Pose> poses;
        for (int frame = 0; frame < 60; ++frame) {
            static_cast<void>(world.advance());
        }
        for (const auto& body : world.scene().bodies) {
            poses.push_back(body->pose());
        }
        return poses;
    };
    const std::vector<Pose> first = run(Technique::cpu);
    const auto expect_near = [&first](const std::vector<Pose>& other, double tolerance) {
        for (std::size_t i = 0; i < first.size(); ++i) {
            EXPECT_NEAR(other[i].translation.x, first[i].translation.x, tolerance) << i;
            EXPECT_NEAR(other[i].translation.y, first[i].translation.y, tolerance) << i;
            EXPECT_NEAR(other[i].angle, first[i].angle, tolerance) << i;
        }
    };
    expect_near(run(Technique::cpu), 0.0);
    expect_near(run(Technique::raster), 0.01);
    expect_near(run(Technique::compute), 0.01);
}

TEST(Backtracking, EqualBoxesExchangeTheirSpeedsByRestitution) {
    for (const double restitution : {1.0, 0.5, 0.0}) {
        Scene scene;
        RigidBody& left = add_body(scene, box(1.0, 1.0), {{-1.0, 0.0}});
        RigidBody& right = add_body(scene, box(1.0, 1.0), {{1.0, 0.0}});
        left.set_motion({1.0, 0.0}, 0.0);
        right.set_motion({-1.0, 0.0}, 0.0);
        scene.touch.restitution = restitution;
        World world = world_of(std::move(scene), Response::backtracking);
        std::size_t events = 0;
        for (int frame = 0; frame < 60; ++frame) {
            events += world.advance().events;
        }
        EXPECT_GT(events, 0U);
        EXPECT_NEAR(right.velocity().x, restitution, 0.02) << restitution;
        EXPECT_NEAR(left.velocity().x, -restitution, 0.02) << restitution;
        EXPECT_NEAR(left.spin(), 0.0, 1e-3);
    }
}

TEST(Backtracking, ACollisionKeepsMomentaAndNeverPenetrates) {
    World world = world_of(meeting_stars(), Response::backtracking);
    const Inventory before = inventory_of(world.scene());
    for (int frame = 0; frame < 240; ++frame) {
        EXPECT_EQ(world.advance().worst_penetration, 0.0) << frame;
    }
    const Inventory after = inventory_of(world.scene());
    EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-10);
    EXPECT_NEAR(after.momentum.y, before.momentum.y, 1e-10);
    // The two points of a contact are up to a tolerance apart.
    EXPECT_NEAR(after.angular_momentum, before.angular_momentum, 0.02);
    EXPECT_LT(after.kinetic_energy, before.kinetic_energy);
}

TEST(Backtracking, AStackComesToRestWhereItStandsWithoutPenetration) {
    World world = world_of(stack_of_boxes(3), Response::backtracking);
    FrameReport report;
    for (int frame = 0; frame < 300; ++frame) {
        report = world.advance();
        EXPECT_EQ(report.worst_penetration, 0.0) << frame;
    }
    // What is left is the opening of contacts within the tolerance.
    EXPECT_LT(report.energies.kinetic, 5e-3);
    for (std::size_t i = 1; i < 4; ++i) {
        const Pose pose = world.scene().bodies[i]->pose();
        EXPECT_NEAR(pose.translation.y, 0.5 + 1.0 * static_cast<double>(i - 1), 0.06) << i;
        EXPECT_NEAR(pose.angle, 0.0, 0.02) << i;
    }
}

TEST(Backtracking, IsTheSameOnEveryRun) {
    const auto run = [] {
        World world = world_of(meeting_stars(), Response::backtracking);
        for (int frame = 0; frame < 120; ++frame) {
            static_cast<void>(world.advance());
        }
        return world.scene().bodies[0]->pose();
    };
    const Pose first = run();
    const Pose second = run();
    EXPECT_EQ(first.translation, second.translation);
    EXPECT_EQ(first.angle, second.angle);
}

TEST(Backtracking, RefusesASceneThatStartsWithAnOverlap) {
    Scene scene;
    add_body(scene, box(1.0, 1.0), {});
    add_body(scene, box(1.0, 1.0), {{0.5, 0.0}});
    EXPECT_THROW(world_of(std::move(scene), Response::backtracking), std::invalid_argument);
}

}  // namespace
}  // namespace nearfield::test
