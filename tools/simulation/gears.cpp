#include <tools/simulation/gear_train.hpp>
#include <tools/simulation/plane.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scenes.hpp>

#include <algorithm>
#include <numbers>
#include <utility>

namespace nearfield::simulation {

Scene gears_scene() {
    Scene scene;
    scene.name = "gears";
    std::size_t number = 0;
    for (const TrainGear& gear : gear_train()) {
        const bool driver = number == 0;
        std::vector<Ring> rings{gear_outline(gear.teeth)};
        if (driver) {  // its shaft has three sides
            rings.push_back({polar(0.3, 0.0), polar(0.3, 2.0 * std::numbers::pi / 3.0),
                             polar(0.3, 4.0 * std::numbers::pi / 3.0)});
        }
        auto body = std::make_unique<RigidBody>(std::move(rings), Pose{gear.place, gear.angle},
                                                driver ? Freedom::directed : Freedom::turning);
        if (driver) {
            scene.act = [motor = body.get()](double time) {
                motor->set_motion({}, driver_spin * std::min(1.0, time));
            };
        }
        scene.bodies.push_back(std::move(body));
        scene.looks.push_back({driver ? 0.08 : 0.5 + 0.03 * static_cast<double>(gear.teeth)});
        ++number;
    }
    scene.surroundings.drag = 0.5;
    scene.touch = {30000.0, 300.0, 0.0, 0.05};
    scene.steps = 6;
    scene.view = {{-5.6, -4.9}, {5.6, 4.9}};
    return scene;
}

}  // namespace nearfield::simulation
