#include <gtest/gtest.h>
#include <tests/simulation/simulation.hpp>
#include <tools/simulation/deformable_body.hpp>
#include <tools/viewer/drag.hpp>

#include <memory>

namespace nearfield::test {
namespace {

using simulation::Scene;
using viewer::Drag;

Drag::Line line_of(const Drag& drag, const Scene& scene) {
    const std::optional<Drag::Line> line = drag.line(scene);
    EXPECT_TRUE(line.has_value());
    return line.value_or(Drag::Line{});
}

/// Lets time pass in steps like those of the viewer.
void step(Scene& scene, const Drag& drag) {
    drag.pull(scene);
    for (const auto& body : scene.bodies) {
        body->accelerate(1.0 / 240.0);
        body->move(1.0 / 240.0);
        body->settle();
    }
}

TEST(Drag, HoldsTheBodyThatIsDrawnOnTop) {
    Scene scene;
    add_body(scene, box(2.0, 2.0), {});
    add_body(scene, box(2.0, 2.0), {{1.0, 0.0}});
    add_body(scene, box(2.0, 2.0), {{5.0, 0.0}});
    Drag drag;
    EXPECT_FALSE(drag.grab(scene, {0.0, 3.0}));
    ASSERT_TRUE(drag.grab(scene, {0.5, 0.25}));
    drag.move({0.5, 2.0});
    step(scene, drag);
    EXPECT_EQ(scene.bodies[0]->center(), (Vector2{0.0, 0.0}));
    EXPECT_GT(scene.bodies[1]->center().y, 0.0);
    EXPECT_EQ(scene.bodies[2]->center(), (Vector2{5.0, 0.0}));
}

TEST(Drag, HoldsThePlaceUnderThePointer) {
    Scene scene;
    add_body(scene, star_ring(), {{3.0, 1.0}, 0.7});
    Ring soft;
    for (int i = 0; i < 60; ++i) {
        soft.push_back(simulation::polar(1.0, 0.10471975511965977 * i));
    }
    scene.bodies.push_back(
        std::make_unique<simulation::DeformableBody>(soft, simulation::Softness{}));
    scene.looks.push_back({});
    for (const Vector2& place : {Vector2{3.2, 1.1}, Vector2{0.3, -0.2}}) {
        Drag drag;
        ASSERT_TRUE(drag.grab(scene, place));
        const Drag::Line line = line_of(drag, scene);
        EXPECT_NEAR(line.from.x, place.x, 1e-12);
        EXPECT_NEAR(line.from.y, place.y, 1e-12);
        EXPECT_EQ(line.to, place);
        // The pointer has not moved, so nothing else does.
        const Vector2 before = scene.bodies[0]->center();
        step(scene, drag);
        EXPECT_NEAR(scene.bodies[0]->center().x, before.x, 1e-12);
        EXPECT_NEAR(scene.bodies[0]->center().y, before.y, 1e-12);
    }
}

TEST(Drag, BringsABodyToThePointerAndNotBeyond) {
    Scene scene;
    add_body(scene, box(2.0, 2.0), {});
    Drag drag;
    ASSERT_TRUE(drag.grab(scene, {0.0, 0.0}));  // at its centre, so that it does not turn
    drag.move({1.0, 0.0});
    for (int i = 0; i < 240; ++i) {
        step(scene, drag);
        EXPECT_LE(scene.bodies[0]->center().x, 1.0 + 1e-9);
    }
    EXPECT_NEAR(scene.bodies[0]->center().x, 1.0, 1e-4);
    drag.release();
    EXPECT_FALSE(drag.line(scene).has_value());
}

}  // namespace
}  // namespace nearfield::test
