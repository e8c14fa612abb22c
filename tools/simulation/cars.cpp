#include <tools/benchmark/outlines.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nearfield::simulation {
namespace {

constexpr std::size_t cars = 18;
constexpr std::size_t lanes = 3;
constexpr double turn = 2.0 * std::numbers::pi;
constexpr Vector2 course_middle{0.0, 0.2};

/// The planned motion of a car around the course: a lane from which it weaves a little, and its
/// scheduled position. Inner lanes are faster, so cars pass each other all the time.
struct Driver {
    double lane = 0.0;   // offset from the middle lane, outwards
    double start = 0.0;  // angle on the course
    double pace = 0.0;   // radians per second
    double mood = 0.0;   // phase of the weaving

    [[nodiscard]] double angle(double time) const {
        return start + pace * time + 0.2 * sine_cosine(0.9 * time + 3.0 * mood).sine;
    }
    [[nodiscard]] Vector2 radii(double time) const {
        // In lane at the start.
        const double beside =
            lane + 0.35 * std::min(1.0, time) * sine_cosine(0.7 * time + mood).sine;
        return {4.3 + beside, 3.1 + beside};
    }
    [[nodiscard]] Vector2 place(double angle, double time) const {
        const Vector2 around = radii(time);
        const auto [sine, cosine] = sine_cosine(angle);
        return course_middle + Vector2{around.x * cosine, around.y * sine};
    }
};

Driver driver_of(std::size_t car) {
    constexpr double lane_width = 0.85;
    constexpr std::size_t per_lane = cars / lanes;
    const std::size_t row = car / lanes;
    const auto lane = static_cast<double>(car % lanes);
    const double slot = static_cast<double>(row) + lane / 3.0;
    return {lane_width * (lane - 1.0), turn * slot / static_cast<double>(per_lane),
            0.62 - 0.13 * lane, 2.4 * static_cast<double>(car)};
}

/// Wheels roll along the car and hardly slip sideways. The car steers towards a point of its lane a
/// little ahead, and drives faster the further it is behind schedule.
void drive(RigidBody& car, const Driver& driver, double time) {
    constexpr double grip = 6.0;      // sideways deceleration per speed
    constexpr double engine = 4.0;    // maximum acceleration and braking deceleration
    constexpr double response = 4.0;  // acceleration per missing speed
    constexpr double fastest = 3.2;
    constexpr double steering = 14.0;  // angular acceleration per angular error
    constexpr double settling = 6.0;   // and per spin
    constexpr double look_ahead = 0.3;
    const Vector2 around = driver.radii(time);
    const Vector2 arm = car.center() - course_middle;
    const double angle = arc_tangent(arm.y / around.y, arm.x / around.x);
    const Vector2 way = driver.place(angle + look_ahead, time) - car.center();
    const Vector2 ahead = polar(1.0, car.angle());
    const Vector2 side = left_of(ahead);
    const double error = arc_tangent(cross(ahead, way), dot(ahead, way));
    const double behind = std::remainder(driver.angle(time) - angle, turn);
    const double radius = length(arm);
    const double wanted = std::clamp(radius * (driver.pace + 1.2 * behind), 0.3, fastest) *
                          std::max(0.25, sine_cosine(error).cosine);
    const Vector2 velocity = car.velocity();
    const double throttle = std::clamp(response * (wanted - dot(velocity, ahead)), -engine, engine);
    car.pull(throttle * ahead - (grip * dot(velocity, side)) * side);
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
        const Driver driver = driver_of(i);
        const Vector2 place = driver.place(driver.start, 0.0);
        const Vector2 way = driver.place(driver.start + 0.01, 0.0) - place;
        auto body = std::make_unique<RigidBody>(std::vector<Ring>{car_outline(i < 14 ? 15 : 14)},
                                                Pose{place, arc_tangent(way.y, way.x)});
        bodies.push_back(body.get());
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({static_cast<double>(i) * 0.618, 0.42});
    }
    scene.touch = {12000.0, 60.0, 0.5, 0.2};
    scene.act = [bodies](double time) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            drive(*bodies[i], driver_of(i), time);
        }
    };
    scene.view = {{-6.3, -4.5}, {6.3, 4.9}};
    return scene;
}

}  // namespace nearfield::simulation
