#include <tools/benchmark/outlines.hpp>
#include <tools/dynamics/plane.hpp>
#include <tools/dynamics/rigid_body.hpp>
#include <tools/scenes/scenes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nearfield::scenes {
namespace {

using namespace dynamics;

constexpr std::size_t cars = 18;

/// Where a car wants to be.
Vector2 goal_of(std::size_t car, double time) {
    const double number = static_cast<double>(car);
    const double across = 0.31 + 0.023 * std::fmod(5.0 * number, 7.0);
    const double along = 0.37 + 0.019 * std::fmod(3.0 * number, 5.0);
    return {5.2 * std::sin(across * time + 2.1 * number),
            3.7 * std::sin(along * time + 1.3 * number + 0.7)};
}

/// Wheels roll along the car and hardly slip sideways; the engine pulls towards the goal.
void drive(RigidBody& car, Vector2 goal) {
    constexpr double grip = 6.0;       // deceleration by speed, sideways
    constexpr double rolling = 0.8;    // forwards
    constexpr double engine = 2.6;     // acceleration
    constexpr double steering = 14.0;  // angular acceleration by the angle that is missing
    constexpr double settling = 6.0;   // and by spin
    const Vector2 ahead = polar(1.0, car.angle());
    const Vector2 side = left_of(ahead);
    const Vector2 way = goal - car.center();
    const double error = std::atan2(cross(ahead, way), dot(ahead, way));
    const double throttle = engine * std::min(1.0, length(way)) * std::max(0.25, std::cos(error));
    const Vector2 velocity = car.velocity();
    car.pull((throttle - rolling * dot(velocity, ahead)) * ahead -
             (grip * dot(velocity, side)) * side);
    car.twist(car.inertia() * (steering * std::clamp(error, -0.8, 0.8) - settling * car.spin()));
}

Ring car_outline(std::size_t vertices) {
    constexpr double size = 0.62;
    Ring ring = benchmark::car(vertices);
    for (Vector2& vertex : ring) {
        vertex = size * vertex;
    }
    return ring;
}

}  // namespace

Scene cars_scene() {
    Scene scene;
    scene.name = "cars";
    std::vector<RigidBody*> bodies;
    for (std::size_t i = 0; i < cars; ++i) {
        const std::size_t row = i / 6;
        const Vector2 place{-5.0 + 2.0 * static_cast<double>(i % 6),
                            -2.4 + 2.4 * static_cast<double>(row)};
        const Vector2 way = goal_of(i, 0.0) - place;
        auto body = std::make_unique<RigidBody>(std::vector<Ring>{car_outline(i < 14 ? 15 : 14)},
                                                Pose{place, std::atan2(way.y, way.x)});
        bodies.push_back(body.get());
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({static_cast<double>(i) * 0.618, 0.42});
    }
    scene.touch = {12000.0, 60.0, 0.5, 0.2};
    scene.act = [bodies](double time) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            drive(*bodies[i], goal_of(i, time));
        }
    };
    scene.view = {{-6.3, -4.5}, {6.3, 4.9}};
    return scene;
}

}  // namespace nearfield::scenes
