#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scenes.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace nearfield::simulation {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double link_length = 1.0;  // from the middle of the socket to that of the ball

void add_arc(Ring& ring, Vector2 middle, double radius, double from, double to,
             std::size_t vertices) {
    for (std::size_t i = 0; i < vertices; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(vertices - 1);
        ring.push_back(middle + polar(radius, degree * std::lerp(from, to, part)));
    }
}

/// A socket about the origin, open at the top, and below it a ball that fits into a socket but not
/// through its opening.
Ring link_outline(std::size_t ball_vertices) {
    constexpr double opening = 38.0;  // degrees on either side of straight up
    constexpr double inner = 0.205;
    constexpr double outer = 0.33;
    constexpr double ball = 0.175;
    constexpr double neck = 20.0;  // degrees on either side, at the socket and at the ball
    Ring ring;
    add_arc(ring, {}, inner, 90.0 - opening, -270.0 + opening, 9);
    add_arc(ring, {}, outer, 90.0 + opening, 270.0 - neck / 2.0, 5);
    add_arc(ring, {0.0, -link_length}, ball, 90.0 + neck, 450.0 - neck, ball_vertices);
    add_arc(ring, {}, outer, 270.0 + neck / 2.0, 450.0 - opening, 5);
    return ring;
}

}  // namespace

Scene links_scene() {
    constexpr std::size_t links = 15;
    constexpr double turn = 12.5 * degree;  // from link to link
    Scene scene;
    scene.name = "links";
    Vector2 socket{-4.6, 2.2};
    std::vector<RigidBody*> ends;
    for (std::size_t i = 0; i < links; ++i) {
        const bool end = i == 0 || i + 1 == links;
        // 0 is straight down: the chain goes downwards from one end and comes up to the other.
        const double lean = turn * (static_cast<double>(i) - static_cast<double>(links - 1) / 2.0) +
                            std::numbers::pi / 2.0;
        auto body = std::make_unique<RigidBody>(
            std::vector<Ring>{link_outline(i % 3 == 0 ? 11 : 10)}, Pose{socket, lean},
            end ? Freedom::directed : Freedom::free);
        if (end) {
            ends.push_back(body.get());
        }
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({end ? 0.08 : 0.55 + 0.2 * static_cast<double>(i % 2)});
        socket += polar(link_length, lean - std::numbers::pi / 2.0);
    }
    scene.surroundings.gravity = {0.0, -5.0};
    scene.surroundings.drag = 0.1;
    scene.touch = {60000.0, 80.0, 0.1, 0.1};
    scene.steps = 10;
    scene.act = [ends](double time) {
        constexpr double reach = 0.7;
        constexpr double pace = 2.2;  // radians per second
        const double speed = reach * pace * sine_cosine(pace * time).sine;
        ends.front()->set_motion({speed, 0.0}, 0.0);
        ends.back()->set_motion({0.0, 0.6 * speed}, 0.0);
    };
    scene.view = {{-6.0, -4.2}, {6.0, 4.2}};
    return scene;
}

}  // namespace nearfield::simulation
