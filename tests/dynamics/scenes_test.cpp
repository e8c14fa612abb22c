#include "simulation.hpp"

#include <gtest/gtest.h>
#include <tools/dynamics/deformable_body.hpp>
#include <tools/scenes/gear_train.hpp>
#include <tools/scenes/scenes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace nearfield::test {
namespace {

using namespace dynamics;

TEST(Scenes, HaveTheObjectsAndLinesOfThePaper) {
    struct Row {
        const char* name;
        std::size_t objects;
        std::size_t lines;
    };
    constexpr Row table[] = {{"map", 6, 719},
                             {"gears", 13, 391},
                             {"links", 15, 440},
                             {"cars", 18, 266},
                             {"wavy", 2, 200}};
    ASSERT_EQ(scenes::paper_scenes().size(), std::size(table));
    for (std::size_t i = 0; i < std::size(table); ++i) {
        const Scene scene = scenes::paper_scenes()[i].make();
        EXPECT_EQ(scene.name, table[i].name);
        EXPECT_EQ(scene.bodies.size(), table[i].objects) << scene.name;
        EXPECT_EQ(line_count(scene), table[i].lines) << scene.name;
        EXPECT_EQ(scene.looks.size(), scene.bodies.size()) << scene.name;
    }
}

TEST(Scenes, GearsTurnByTheRatioOfTheirTeethThroughContactAlone) {
    for (const Response response : {Response::penalty, Response::backtracking}) {
        SCOPED_TRACE(response == Response::penalty ? "penalty" : "backtracking");
        World world(simulation_context(), scenes::gears_scene(), response, Technique::cpu);
        const int frames = response == Response::penalty ? 600 : 240;
        double worst = 0.0;
        for (int frame = 0; frame < frames; ++frame) {
            worst = std::max(worst, world.advance().worst_penetration);
        }
        EXPECT_LT(worst, response == Response::penalty ? 0.04 : 1e-300);
        const std::vector<scenes::TrainGear> train = scenes::gear_train();
        const double driven =
            world.scene().bodies[0]->pose().angle * static_cast<double>(train[0].teeth);
        EXPECT_GT(driven, 0.7 * scenes::driver_spin * world.time() * 9.0) << "the driver turns";
        for (std::size_t i = 1; i < train.size(); ++i) {
            const double sign = train[i].driver == 0 ? -1.0 : 1.0;
            // Counted in teeth: a tooth of play a mesh at the very most, however far they turn.
            const double teeth = (world.scene().bodies[i]->pose().angle - train[i].angle) *
                                 static_cast<double>(train[i].teeth) / (2.0 * std::numbers::pi);
            const double play = train[i].driver == 0 ? 0.3 : 0.6;
            EXPECT_NEAR(teeth, sign * driven / (2.0 * std::numbers::pi), play) << i;
        }
    }
}

TEST(Scenes, LinksHangTogether) {
    for (const Response response : {Response::penalty, Response::backtracking}) {
        World world(simulation_context(), scenes::links_scene(), response, Technique::cpu);
        double worst = 0.0;
        for (int frame = 0; frame < 240; ++frame) {
            worst = std::max(worst, world.advance().worst_penetration);
        }
        EXPECT_LT(worst, response == Response::penalty ? 0.03 : 1e-300);
        for (std::size_t i = 0; i + 1 < world.scene().bodies.size(); ++i) {
            // The ball of a link is in the socket of the next.
            const auto& body = dynamic_cast<const RigidBody&>(*world.scene().bodies[i]);
            const auto& next = dynamic_cast<const RigidBody&>(*world.scene().bodies[i + 1]);
            const Vector2 ball = placed(body.pose(), Vector2{0.0, -1.0} - body.plate().centroid);
            const Vector2 socket = placed(next.pose(), -next.plate().centroid);
            EXPECT_LT(length(ball - socket), 0.1) << i;
        }
    }
}

TEST(Scenes, CarsBumpAndStayOnTheGround) {
    World world(simulation_context(), scenes::cars_scene(), Response::backtracking, Technique::cpu);
    std::size_t events = 0;
    for (int frame = 0; frame < 300; ++frame) {
        const FrameReport report = world.advance();
        events += report.events;
        EXPECT_EQ(report.worst_penetration, 0.0) << frame;
    }
    EXPECT_GT(events, 0U);
    for (const auto& body : world.scene().bodies) {
        EXPECT_LT(std::abs(body->center().x), 7.0);
        EXPECT_LT(std::abs(body->center().y), 5.5);
    }
}

TEST(Scenes, AWaveIsHandedFromTheRightBarToTheLeft) {
    World world(simulation_context(), scenes::wavy_scene(), Response::penalty, Technique::cpu);
    const Body& left = *world.scene().bodies[0];
    const Body& right = *world.scene().bodies[1];
    const auto energy = [](const Body& body) {
        const Inventory inventory = body.inventory();
        return inventory.kinetic_energy + inventory.elastic_energy;
    };
    for (int frame = 0; frame < 40; ++frame) {
        static_cast<void>(world.advance());
    }
    const double given = energy(right);
    EXPECT_GT(given, 0.05);
    EXPECT_LT(energy(left), 1e-3 * given) << "not there yet";
    double handed = 0.0;
    for (int frame = 40; frame < 290; ++frame) {
        static_cast<void>(world.advance());
        handed = std::max(handed, energy(left));
    }
    EXPECT_GT(handed, 0.05 * given);
    EXPECT_LT(handed, given);
}

TEST(Scenes, BarsFarInsideEachOtherArePushedApart) {
    World world(simulation_context(), scenes::overlap_scene(), Response::penalty, Technique::cpu);
    double start = 0.0;
    for (const auto& overlap : world.proximity().overlaps()) {
        start = std::max(start, overlap.first_in_second->deepest.depth);
    }
    EXPECT_GT(start, 0.3);
    FrameReport report;
    for (int frame = 0; frame < 360; ++frame) {
        report = world.advance();
    }
    EXPECT_LT(report.energies.contact, 0.05);
    for (const auto& overlap : world.proximity().overlaps()) {
        EXPECT_LT(overlap.first_in_second->deepest.depth, 0.1);
    }
    for (const auto& body : world.scene().bodies) {
        const auto& bar = dynamic_cast<const DeformableBody&>(*body);
        EXPECT_NEAR(bar.area(), bar.rest_area(), 0.05 * bar.rest_area());
    }
}

TEST(Scenes, CountriesDoNotFlyApartNorMerge) {
    World world(simulation_context(), scenes::map_scene(), Response::penalty, Technique::cpu);
    for (int frame = 0; frame < 300; ++frame) {
        EXPECT_LT(world.advance().worst_penetration, 0.3) << frame;
    }
    for (const auto& body : world.scene().bodies) {
        EXPECT_LT(length(body->center()), 4.5);
    }
}

TEST(Scenes, WhatIsPouredStaysInTheContainer) {
    World world(simulation_context(), scenes::pour_scene(100), Response::penalty, Technique::cpu);
    FrameReport report;
    for (int frame = 0; frame < 400; ++frame) {
        report = world.advance();
        EXPECT_EQ(report.queries.batches, 1U);
    }
    for (std::size_t i = 1; i < world.scene().bodies.size(); ++i) {
        const Vector2 center = world.scene().bodies[i]->center();
        EXPECT_LT(std::abs(center.x), 8.0) << i;
        EXPECT_GT(center.y, -7.0) << i;
        EXPECT_LT(center.y, -4.0) << i;
    }
    EXPECT_LT(report.energies.kinetic, 0.5);
}

}  // namespace
}  // namespace nearfield::test
