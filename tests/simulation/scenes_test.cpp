#include "simulation.hpp"

#include <gtest/gtest.h>
#include <tools/simulation/deformable_body.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace nearfield::test {
namespace {

using namespace simulation;

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
    ASSERT_EQ(simulation::paper_scenes().size(), std::size(table));
    for (std::size_t i = 0; i < std::size(table); ++i) {
        const Scene scene = simulation::paper_scenes()[i].make();
        EXPECT_EQ(scene.name, table[i].name);
        EXPECT_EQ(scene.bodies.size(), table[i].objects) << scene.name;
        EXPECT_EQ(simulation::line_count(scene), table[i].lines) << scene.name;
        EXPECT_EQ(scene.looks.size(), scene.bodies.size()) << scene.name;
    }
}

TEST(Scenes, GearsTurnByTheRatioOfTheirTeethThroughContactAlone) {
    for (const Response response : {Response::penalty, Response::backtracking}) {
        SCOPED_TRACE(response == Response::penalty ? "penalty" : "backtracking");
        simulation::World world(simulation_context(), simulation::gears_scene(), response,
                                Technique::cpu);
        const int frames = response == Response::penalty ? 600 : 240;
        // A tooth is 0.22 of a pitch wide at its tip and 0.345 half way up; the gap beside it is
        // the rest. If half a tip penetrated, teeth would slip next.
        constexpr double pitch = 2.0 * std::numbers::pi * 0.125;
        constexpr double half_a_tip = 0.11 * pitch;
        double worst = 0.0;
        std::size_t stopped = 0;
        for (int frame = 0; frame < frames; ++frame) {
            const FrameReport report = world.advance();
            worst = std::max(worst, report.worst_penetration);
            stopped += report.stopped;
        }
        EXPECT_EQ(stopped, 0U);
        if (response == Response::penalty) {
            EXPECT_LT(worst, half_a_tip);
        } else {
            EXPECT_EQ(worst, 0.0);
        }
        const std::vector<simulation::TrainGear> train = simulation::gear_train();
        // It takes a second to reach its speed, accurate to one step.
        const double turned = world.scene().bodies[0]->pose().angle;
        EXPECT_NEAR(turned, simulation::driver_spin * (world.time() - 0.5),
                    simulation::driver_spin * world.scene().frame_time / world.scene().steps);
        const double driven = turned * static_cast<double>(train[0].teeth);
        const double play_of_a_mesh = 0.5 * (1.0 - 2.0 * 0.345) + worst / pitch;
        for (std::size_t i = 1; i < train.size(); ++i) {
            const double sign = train[i].driver == 0 ? -1.0 : 1.0;
            // In teeth: the error is at most the play of its meshes, however far they turn.
            const double teeth = (world.scene().bodies[i]->pose().angle - train[i].angle) *
                                 static_cast<double>(train[i].teeth) / (2.0 * std::numbers::pi);
            const double meshes = train[i].driver == 0 ? 1.0 : 2.0;
            EXPECT_NEAR(teeth, sign * driven / (2.0 * std::numbers::pi), meshes * play_of_a_mesh)
                << i;
        }
    }
}

TEST(Scenes, LinksHangTogether) {
    // The inradius of a ball with nine or ten sides. It leaves the socket only if it penetrates
    // both sides of the opening.
    constexpr double degree = std::numbers::pi / 180.0;
    const double ball_radius = 0.175 * std::cos(320.0 / 9.0 / 2.0 * degree);
    const double half_opening = 0.205 * std::sin(38.0 * degree);
    const double slip = ball_radius - half_opening;
    // Its clearance: up to the wall, or into the opening until it touches both of its sides.
    const double room = std::max(0.205 - ball_radius, 0.205 * std::cos(38.0 * degree) -
                                                          std::sqrt(ball_radius * ball_radius -
                                                                    half_opening * half_opening));
    for (const Response response : {Response::penalty, Response::backtracking}) {
        simulation::World world(simulation_context(), simulation::links_scene(), response,
                                Technique::cpu);
        double worst = 0.0;
        for (int frame = 0; frame < 240; ++frame) {
            worst = std::max(worst, world.advance().worst_penetration);
        }
        if (response == Response::penalty) {
            EXPECT_LT(worst, slip);
        } else {
            EXPECT_EQ(worst, 0.0);
        }
        for (std::size_t i = 0; i + 1 < world.scene().bodies.size(); ++i) {
            // The ball of a link is in the socket of the next.
            const auto& body = dynamic_cast<const simulation::RigidBody&>(*world.scene().bodies[i]);
            const auto& next =
                dynamic_cast<const simulation::RigidBody&>(*world.scene().bodies[i + 1]);
            const Vector2 ball =
                simulation::placed(body.pose(), Vector2{0.0, -1.0} - body.plate().centroid);
            const Vector2 socket = simulation::placed(next.pose(), -next.plate().centroid);
            EXPECT_LT(simulation::length(ball - socket), room + worst) << i;
        }
    }
}

TEST(Scenes, CarsDriveRoundAndBumpForAsLongAsTheyRun) {
    for (const Response response : {Response::penalty, Response::backtracking}) {
        SCOPED_TRACE(response == Response::penalty ? "penalty" : "backtracking");
        simulation::World world(simulation_context(), simulation::cars_scene(), response,
                                Technique::cpu);
        const Scene& scene = world.scene();
        const auto angle_of = [](const Body& car) {
            return std::atan2((car.center().y - 0.2) / 3.1, car.center().x / 4.3);
        };
        std::vector<double> last;
        std::vector<double> driven(scene.bodies.size(), 0.0);
        for (const auto& car : scene.bodies) {
            last.push_back(angle_of(*car));
        }
        for (int quarter = 0; quarter < 4; ++quarter) {
            std::size_t contacts = 0;
            for (int frame = 0; frame < 250; ++frame) {
                const FrameReport report = world.advance();
                contacts += report.contacts;
                if (response == Response::backtracking) {
                    ASSERT_EQ(report.worst_penetration, 0.0);
                }
                for (std::size_t i = 0; i < last.size(); ++i) {
                    const double angle = angle_of(*scene.bodies[i]);
                    driven[i] += std::remainder(angle - last[i], 2.0 * std::numbers::pi);
                    last[i] = angle;
                }
            }
            EXPECT_GT(contacts, 0U) << "quarter " << quarter;
            // The slowest lane's pace is 0.36 radians per second. A car that lags by more than the
            // sixth of a round, the distance to the next car of its lane, has been stuck.
            for (std::size_t i = 0; i < driven.size(); ++i) {
                EXPECT_GT(driven[i], 0.36 * world.time() - std::numbers::pi / 3.0) << i;
                EXPECT_TRUE(std::abs(scene.bodies[i]->center().x) < scene.view.max.x &&
                            scene.bodies[i]->center().y < scene.view.max.y &&
                            scene.bodies[i]->center().y > scene.view.min.y)
                    << i;
            }
        }
    }
}

TEST(Scenes, AWaveIsHandedFromTheRightBarToTheLeft) {
    simulation::World world(simulation_context(), simulation::wavy_scene(), Response::penalty,
                            Technique::cpu);
    const Body& left = *world.scene().bodies[0];
    const Body& right = *world.scene().bodies[1];
    const auto energy = [](const Body& body) {
        const Inventory inventory = body.inventory();
        return inventory.kinetic_energy + inventory.elastic_energy;
    };
    for (int frame = 0; frame < 40; ++frame) {
        static_cast<void>(world.advance());
    }
    // The push is over, and the wave travels below the end of the other bar.
    const double given = energy(right);
    EXPECT_GT(given, 0.0);
    EXPECT_LT(energy(left), 1e-12 * given) << "not there yet: rounding alone";
    double handed = 0.0;
    for (int frame = 40; frame < 290; ++frame) {
        static_cast<void>(world.advance());
        handed = std::max(handed, energy(left));
        EXPECT_LT(energy(left) + energy(right), given) << "nobody else pushes";
    }
    // As the wave passes, it presses in the other bar's face like its own. Half of the wave is in
    // contact; the energy that the other bar gains from it is at least a tenth.
    EXPECT_GT(handed, 0.1 * given);
}

TEST(Scenes, BarsFarInsideEachOtherArePushedApart) {
    simulation::World world(simulation_context(), simulation::overlap_scene(), Response::penalty,
                            Technique::cpu);
    const Scene& scene = world.scene();
    double start = 0.0;
    for (const auto& overlap : world.proximity().overlaps()) {
        start = std::max(start, overlap.first_in_second->deepest.depth);
    }
    // Bars of 1.9 by 3.4 that overlap by 0.6.
    EXPECT_NEAR(start, 0.6, scene.tolerance);
    const double stored = world.advance().energies.contact;
    simulation::FrameReport report;
    for (int frame = 1; frame < 360; ++frame) {
        report = world.advance();
    }
    // At rest they lie side by side, attracted with a force of mass times distance from the middle,
    // which a face about 2 long must bear. Because it is soft, it is pressed in like a parabola, so
    // half as much again in its middle, and may oscillate by half of that.
    const double force = inventory_of(scene).mass / 2.0 * scene.surroundings.attraction * 0.95;
    const double depth = force / (scene.touch.stiffness * 2.0);
    for (const auto& overlap : world.proximity().overlaps()) {
        EXPECT_LT(overlap.first_in_second->deepest.depth, 1.5 * 1.5 * depth);
    }
    EXPECT_LT(report.energies.contact, stored * depth / start);
    for (const auto& body : scene.bodies) {
        const auto& bar = dynamic_cast<const simulation::DeformableBody&>(*body);
        // The pressure bears the same force on the same face.
        EXPECT_NEAR(bar.area(), bar.rest_area(), 1.5 * force / 2.0 / 20.0 * bar.rest_area());
    }
}

TEST(Scenes, CountriesDoNotFlyApartNorMerge) {
    simulation::World world(simulation_context(), simulation::map_scene(), Response::penalty,
                            Technique::cpu);
    const Scene& scene = world.scene();
    // The potential energy released by the two heaviest bodies from their starting points to the
    // middle.
    double heaviest = 0.0;
    for (const auto& body : scene.bodies) {
        heaviest = std::max(heaviest, body->inventory().mass);
    }
    constexpr double far = 3.9;
    const double energy = 2.0 * 0.5 * heaviest * scene.surroundings.attraction * far * far;
    const double deepest = deepest_by_energy(energy, scene.touch.stiffness);
    for (int frame = 0; frame < 300; ++frame) {
        EXPECT_LT(world.advance().worst_penetration, deepest) << frame;
    }
    // The stirring does not lift them above their starting positions.
    for (const auto& body : scene.bodies) {
        EXPECT_LT(simulation::length(body->center()), far);
    }
}

TEST(Scenes, WhatIsPouredComesToRestInTheContainer) {
    constexpr std::size_t stars = 60;
    simulation::World world(simulation_context(), simulation::pour_scene(stars), Response::penalty,
                            Technique::cpu);
    const Scene& scene = world.scene();
    simulation::FrameReport report;
    double worst = 0.0;
    for (int frame = 0; frame < 1500; ++frame) {
        report = world.advance();
        EXPECT_EQ(report.queries.batches, 1U);
        worst = std::max(worst, report.worst_penetration);
    }
    // 3 rows of 20 stars of size at most 0.64 in a container 16 wide: in any arrangement no higher
    // than all of them upright.
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        const Vector2 center = scene.bodies[i]->center();
        EXPECT_LT(std::abs(center.x), 8.0) << i;
        EXPECT_GT(center.y, -7.0) << i;
        EXPECT_LT(center.y, -7.0 + 3.0 * 0.64) << i;
    }
    // A star is nowhere thicker than its inner circle, 0.55 of its size: never so deep that the way
    // out could be on the other side.
    EXPECT_LT(worst, 0.55 * 0.24);
    // At rest: nothing moves by the tolerance in a second.
    const double mass = inventory_of(scene).mass;
    const double slow = scene.tolerance;
    EXPECT_LT(report.energies.kinetic, 0.5 * mass * slow * slow);
}

}  // namespace
}  // namespace nearfield::test
