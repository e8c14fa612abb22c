#include <tools/benchmark/random.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <numbers>
#include <utility>

namespace nearfield::simulation {
namespace {

Ring star(double size, std::size_t points) {
    Ring ring;
    for (std::size_t i = 0; i < 2 * points; ++i) {
        const double angle =
            std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
        ring.push_back(polar(i % 2 == 0 ? size : 0.55 * size, angle));
    }
    return ring;
}

}  // namespace

Scene pour_scene(std::size_t bodies) {
    constexpr double half_width = 8.0;
    constexpr double floor = -7.0;
    constexpr double wall = 1.0;
    constexpr std::size_t columns = 20;
    Scene scene;
    scene.name = "pour";
    // A container that is open at the top.
    const Ring container{{-half_width - wall, floor - wall},
                         {half_width + wall, floor - wall},
                         {half_width + wall, 7.0},
                         {half_width, 7.0},
                         {half_width, floor},
                         {-half_width, floor},
                         {-half_width, 7.0},
                         {-half_width - wall, 7.0}};
    scene.bodies.push_back(
        std::make_unique<RigidBody>(std::vector<Ring>{container}, Pose{}, Freedom::directed));
    scene.looks.push_back({0.6});
    benchmark::Random random(6);
    for (std::size_t i = 0; i < bodies; ++i) {
        const std::size_t row = i / columns;
        const Vector2 place{
            0.7 * (static_cast<double>(i % columns) - 0.5 * static_cast<double>(columns - 1)) +
                random.between(-0.05, 0.05),
            floor + 1.0 + 0.7 * static_cast<double>(row)};
        scene.bodies.push_back(
            std::make_unique<RigidBody>(std::vector<Ring>{star(random.between(0.24, 0.32), 5)},
                                        Pose{place, random.between(0.0, std::numbers::pi)}));
        scene.looks.push_back({random.between(0.0, 1.0)});
    }
    scene.surroundings.gravity = {0.0, -5.0};
    scene.surroundings.drag = 1.0;
    scene.touch = {2500.0, 16.0, 0.3, 0.1};
    // Short enough for stability: with springs about a star on all sides, and those of its
    // neighbours, frequency * time is about 1.
    scene.frame_time = 1.0 / 240.0;
    scene.steps = 1;
    scene.view = {{-10.0, -8.5}, {10.0, 8.5}};
    return scene;
}

}  // namespace nearfield::simulation
