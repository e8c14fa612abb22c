#include <engine/geometry/transformed_polygon.hpp>
#include <engine/toi/motion.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::toi {
namespace {

using geometry::Polygon;
using geometry::Vector;

Vector vertex_at(const Motion& motion, std::uint32_t vertex, double time) {
    return geometry::TransformedPolygon(motion.polygon(), motion.at(time)).vertex(vertex);
}

Polygon any_polygon(test::Random& random) {
    return samples::polygon(test::scaled_and_moved(
        test::star(random, 5, 0.2), 1.0, {random.between(-3.0, 3.0), random.between(-3.0, 3.0)}));
}

Pose any_pose(test::Random& random) {
    return {{random.between(-4.0, 4.0), random.between(-4.0, 4.0)},
            random.below(4) == 0 ? 0.0 : random.between(-7.0, 7.0)};
}

TEST(Motion, VelocityAndAccelerationAreTheDerivatives) {
    test::Random random(511);
    for (int i = 0; i < 200; ++i) {
        const Polygon polygon = any_polygon(random);
        const Motion motion(polygon, any_pose(random), any_pose(random));
        const double time = random.between(0.1, 0.9);
        const MotionState state(motion, motion.at(time));
        for (std::uint32_t vertex = 0; vertex < 5; ++vertex) {
            const double step = 1e-4;
            const Vector at = vertex_at(motion, vertex, time);
            const Vector before = vertex_at(motion, vertex, time - step);
            const Vector after = vertex_at(motion, vertex, time + step);
            EXPECT_LE(((after - before) / (2.0 * step) - state.velocity_at(at)).norm(), 1e-4);
            EXPECT_NEAR((after - 2.0 * at + before).norm() / (step * step),
                        state.acceleration_at(at), 1e-3 * (1.0 + state.acceleration_at(at)));
        }
    }
}

/// How far and along what way a vertex of each moves relative to the other.
struct Way {
    double length = 0.0;
    double path = 0.0;
};

Way way_of(const Motion& a, std::uint32_t of_a, const Motion& b, std::uint32_t of_b, double from,
           double time) {
    constexpr int pieces = 200;
    Way way;
    const auto between = [&](double at) -> Vector {
        return vertex_at(b, of_b, at) - vertex_at(a, of_a, at);
    };
    const Vector start = between(from);
    Vector last = start;
    for (int k = 1; k <= pieces; ++k) {
        const Vector now = between(from + time * k / pieces);
        way.path += (now - last).norm();
        way.length = std::max(way.length, (now - start).norm());
        last = now;
    }
    return way;
}

TEST(Motion, BoundsHoldForAllVertices) {
    test::Random random(512);
    for (int i = 0; i < 300; ++i) {
        const Polygon of_a = any_polygon(random);
        const Polygon of_b = any_polygon(random);
        const Motion a(of_a, any_pose(random), any_pose(random));
        const Motion b(of_b, any_pose(random), any_pose(random));
        const double from = random.between(0.0, 0.7);
        const RelativeMotion motion(a, {a, a.at(from)}, b, {b, b.at(from)});
        const double time = random.between(0.0, 1.0 - from);
        for (std::uint32_t k = 0; k < 25; ++k) {
            const Way way = way_of(a, k / 5, b, k % 5, from, time);
            EXPECT_LE(way.length, motion.length(time) * (1.0 + 1e-12));
            EXPECT_LE(way.path, motion.path(time) * (1.0 + 1e-12));
        }
        // The inverse of the bound.
        for (const double length : {1e-3, 0.5, 30.0}) {
            const double until = motion.time(length);
            if (std::isfinite(until)) {
                EXPECT_LE(motion.length(until), length * (1.0 + 1e-9));
                EXPECT_GE(motion.length(until * (1.0 + 1e-6)), length * (1.0 - 1e-9));
            }
        }
    }
}

TEST(Motion, BoundsAreReachedByPlainMotions) {
    const Polygon bar = samples::polygon(test::rectangle({-1.0, -0.0625}, {1.0, 0.0625}));
    const Motion rest(bar, {}, {});
    const Motion straight(bar, {}, {{3.0, 4.0}, 0.0});
    const RelativeMotion to(rest, {rest, rest.at(0.0)}, straight, {straight, straight.at(0.0)});
    EXPECT_NEAR(to.length(0.5), 2.5, 1e-12);
    EXPECT_NEAR(to.path(0.5), 2.5, 1e-12);
    EXPECT_NEAR(to.time(2.5), 0.5, 1e-12);
    // About its own middle, by half a turn: no farther than to the other side.
    const Motion spun(bar, {}, {{0.0, 0.0}, 3.0});
    const RelativeMotion about(rest, {rest, rest.at(0.0)}, spun, {spun, spun.at(0.0)});
    const double radius = std::hypot(1.0, 0.0625);
    EXPECT_NEAR(about.path(1.0), 3.0 * radius, 1e-12);
    EXPECT_NEAR(about.length(1.0), 2.0 * radius, 1e-12);
    EXPECT_TRUE(std::isinf(about.time(2.1)));
    // Against itself the same way round.
    const RelativeMotion both(spun, {spun, spun.at(0.0)}, spun, {spun, spun.at(0.0)});
    EXPECT_NEAR(both.path(1.0), 6.0 * radius, 1e-12);
}

}  // namespace
}  // namespace nearfield::toi
