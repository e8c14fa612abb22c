#include <tools/simulation/countries.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scenes.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace nearfield::simulation {

Scene map_scene() {
    Scene scene;
    scene.name = "map";
    std::vector<Ring> outlines = countries(3.0);
    std::vector<RigidBody*> bodies;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const double turn = static_cast<double>(i) / static_cast<double>(outlines.size());
        const Pose pose{polar(3.9, 2.0 * std::numbers::pi * turn),
                        0.6 * sine_cosine(5.0 * turn).sine};
        auto body = std::make_unique<RigidBody>(std::vector<Ring>{std::move(outlines[i])}, pose);
        bodies.push_back(body.get());
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({0.12 + turn});
    }
    scene.surroundings.attraction = 1.0;
    scene.surroundings.drag = 0.15;
    scene.touch = {6000.0, 60.0, 0.2, 0.2};
    scene.steps = 6;
    scene.act = [bodies](double time) {
        // Stirs in both directions, the outer bodies as strongly as the inner ones.
        constexpr double strength = 1.2;
        const double stir = strength * sine_cosine(0.9 * time).sine;
        for (RigidBody* body : bodies) {
            const double distance = length(body->center());
            body->pull((stir / (1.0 + distance)) * left_of(body->center()));
        }
    };
    scene.view = {{-4.8, -4.0}, {4.8, 4.0}};
    return scene;
}

}  // namespace nearfield::simulation
