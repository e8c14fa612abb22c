#include "scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::test {
namespace {

std::vector<Sweep> any_sweeps(Random& random, const Scene& scene, const Rectangle& box, int count) {
    std::vector<Sweep> sweeps;
    for (int i = 0; i < count; ++i) {
        const Pose start{any_point(random, scene, box), random.between(-4.0, 4.0)};
        Pose end{any_point(random, scene, box), start.angle};
        if (random.whole(0, 1) == 0) {
            end.angle += random.between(-3.0, 3.0);
        }
        if (random.whole(0, 5) == 0) {
            end.translation = start.translation;  // it only turns, or stays
        }
        sweeps.push_back({start, end});
    }
    return sweeps;
}

TimeOfImpactQuery query_of(const ShapeCastQuery& query, const Sweep& sweep,
                           const Instance& instance) {
    TimeOfImpactQuery impact;
    impact.a = {query.shape, sweep.start};
    impact.end_a = sweep.end;
    impact.b = instance;
    impact.end_b = instance.pose;
    impact.tolerance = query.tolerance;
    impact.contact_distance = query.contact_distance;
    return impact;
}

/// The earliest of the times of impact with every instance that passes; at time 0, what is touched
/// at the start comes before what is hit a moment later.
ShapeCastHit earliest(Scene& scene, const ShapeCastQuery& query, const WorldFilter& filter,
                      const Sweep& sweep) {
    ShapeCastHit first;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        if (!scene.passes(i, filter)) {
            continue;
        }
        const auto found = scene.context().answer(query_of(query, sweep, scene.instance(i)));
        EXPECT_TRUE(found.has_value()) << found.error().text();
        const auto order = [](ImpactState state, double time) {
            return std::pair(time, state != ImpactState::intersecting_at_start);
        };
        if (found->state == ImpactState::separated ||
            (first.state != ImpactState::separated &&
             order(found->state, found->time) >= order(first.state, first.time))) {
            continue;
        }
        first = {found->state,       scene.handle(i), found->time,    found->time_error_bound,
                 found->error_bound, found->point_a,  found->point_b, found->direction};
    }
    return first;
}

void check_equal(const ShapeCastHit& hit, const ShapeCastHit& expected) {
    EXPECT_EQ(hit.state, expected.state);
    EXPECT_EQ(hit.instance, expected.instance);
    EXPECT_EQ(hit.time, expected.time);
    EXPECT_EQ(hit.time_error_bound, expected.time_error_bound);
    EXPECT_EQ(hit.error_bound, expected.error_bound);
    EXPECT_EQ(hit.point, expected.point);
    EXPECT_EQ(hit.nearest, expected.nearest);
    EXPECT_EQ(hit.direction, expected.direction);
}

/// Before the time of a hit, the shape is farther away than the contact distance; at its end it is
/// not.
void check_never_late(Scene& scene, const ShapeCastQuery& query, const WorldOptions& options,
                      const Sweep& sweep, const ShapeCastHit& hit) {
    const auto pose_at = [&](double time) {
        return Pose{{sweep.start.translation.x +
                         time * (sweep.end.translation.x - sweep.start.translation.x),
                     sweep.start.translation.y +
                         time * (sweep.end.translation.y - sweep.start.translation.y)},
                    sweep.start.angle + time * (sweep.end.angle - sweep.start.angle)};
    };
    std::vector<Pose> before;
    for (int i = 0; i < 20; ++i) {
        before.push_back(pose_at(hit.time * i / 20.0));
    }
    if (hit.state == ImpactState::intersecting_at_start) {
        EXPECT_EQ(hit.time, 0.0);
        return;
    }
    std::vector<Clearance> clearances(before.size());
    ASSERT_TRUE(scene.world().find_clearances({query.shape}, before, clearances, options).ok());
    for (const Clearance& clearance : clearances) {
        EXPECT_GE(clearance.distance, query.contact_distance - clearance.error_bound);
    }
    if (hit.state == ImpactState::hit) {
        const Pose end = pose_at(std::min(1.0, hit.time + hit.time_error_bound));
        Clearance there;
        ASSERT_TRUE(
            scene.world().find_clearances({query.shape}, {&end, 1}, {&there, 1}, options).ok());
        EXPECT_LE(there.distance, query.contact_distance + query.tolerance + hit.error_bound);
    }
}

class WorldCasts : public testing::TestWithParam<int> {};

TEST_P(WorldCasts, AreTheEarliestTimeOfImpact) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(2); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 57U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        const Rectangle box = box_of(scene.placements());
        Random random(seed + 1);
        ShapeCastQuery query;
        query.shape = scene.add_shape(scaled_and_moved(star(random, random.whole(3, 40), 0.3),
                                                       random.scale(0.02, 1.0),
                                                       {random.between(-1.0, 1.0), 0.0}));
        const WorldOptions options{.filter = any_filter(random, scene)};
        // As small as double precision resolves at these coordinates.
        const double size =
            std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x),
                      std::abs(box.max.y), kind == SceneKind::far_origin ? 1e8 : 1e7});
        query.tolerance = random.scale(1e-11, 1e-9) * size;
        query.contact_distance = random.whole(0, 1) == 0 ? 0.0 : random.scale(1e-3, 0.3);
        const std::vector<Sweep> sweeps = any_sweeps(random, scene, box, 10);
        std::vector<ShapeCastHit> hits(sweeps.size());
        const Status status = scene.world().cast_shape(query, sweeps, hits, options);
        ASSERT_TRUE(status.ok()) << status.text();
        for (std::size_t i = 0; i < sweeps.size(); ++i) {
            SCOPED_TRACE("sweep " + std::to_string(i));
            check_equal(hits[i], earliest(scene, query, options.filter, sweeps[i]));
            check_never_late(scene, query, options, sweeps[i], hits[i]);
            if (HasFatalFailure() || HasNonfatalFailure()) {
                return;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldCasts, testing::Range(0, scene_kinds));

TEST(WorldCastsOfSquares, TouchAtTheExpectedTimes) {
    Scene scene({{"square", rectangle({0, 0}, {1, 1}), {{5.0, 0.0}}},
                 {"its twin", rectangle({0, 0}, {1, 1}), {{5.0, 0.0}}},
                 {"nearer", rectangle({0, 0}, {1, 1}), {{3.0, 4.0}}}});
    ShapeCastQuery query{scene.add_shape(rectangle({0, 0}, {1, 1}))};
    query.tolerance = 1e-9;
    const std::vector<Sweep> sweeps{{{{0, 0}, 0}, {{8, 0}, 0}},
                                    {{{0, 4}, 0}, {{8, 4}, 0}},
                                    {{{0, 2}, 0}, {{8, 2}, 0}},
                                    {{{5, 0.5}, 0}, {{9, 9}, 0}}};
    std::vector<ShapeCastHit> hits(sweeps.size());
    ASSERT_TRUE(scene.world().cast_shape(query, sweeps, hits).ok());
    EXPECT_EQ(hits[0].state, ImpactState::hit);
    EXPECT_NEAR(hits[0].time, 0.5, 1e-9);
    EXPECT_EQ(hits[0].instance, scene.handle(0));
    EXPECT_NEAR(hits[1].time, 0.25, 1e-9);
    EXPECT_EQ(hits[1].instance, scene.handle(2));
    EXPECT_EQ(hits[2].state, ImpactState::separated);
    EXPECT_EQ(hits[2].instance, InstanceHandle());
    EXPECT_EQ(hits[2].time, 1.0);
    EXPECT_EQ(hits[3].state, ImpactState::intersecting_at_start);
    EXPECT_EQ(hits[3].time, 0.0);
    EXPECT_EQ(hits[3].instance, scene.handle(0));
}

TEST(WorldCastsOfSquares, ComeWithinTheContactDistanceBesideTheirPath) {
    Scene scene({{"beside the path", rectangle({0, 0}, {1, 1}), {{4.0, 1.25}}}});
    ShapeCastQuery query{scene.add_shape(rectangle({0, 0}, {1, 1}))};
    query.tolerance = 1e-9;
    const Sweep sweep{{{0, 0}, 0}, {{8, 0}, 0}};
    ShapeCastHit hit;
    for (const double contact_distance : {0.2, 0.25, 0.5}) {
        query.contact_distance = contact_distance;
        ASSERT_TRUE(scene.world().cast_shape(query, {&sweep, 1}, {&hit, 1}).ok());
        EXPECT_EQ(hit.state, contact_distance < 0.25 ? ImpactState::separated : ImpactState::hit);
    }
    // The corners come within 0.5: 0.25 above, and so much before.
    EXPECT_NEAR(hit.time, (3.0 - std::sqrt(0.25 - 0.0625)) / 8.0, 1e-8);
}

TEST(WorldCastsOfBars, ThatTurnHitWhatIsFarFromTheirStartAndTheirEnd) {
    // A bar that turns half a circle about its end, from the right to the left.
    Scene scene({{"above", rectangle({-0.5, 0}, {0.5, 1}), {{0.0, 9.0}}},
                 {"out of reach", rectangle({-0.5, 0}, {0.5, 1}), {{0.0, 10.5}}}});
    ShapeCastQuery query{scene.add_shape(rectangle({0, -0.1}, {10, 0.1}))};
    query.tolerance = 1e-9;
    const Sweep sweep{{{0, 0}, 0}, {{0, 0}, std::numbers::pi}};
    ShapeCastHit hit;
    ASSERT_TRUE(scene.world().cast_shape(query, {&sweep, 1}, {&hit, 1}).ok());
    ASSERT_EQ(hit.state, ImpactState::hit);
    EXPECT_EQ(hit.instance, scene.handle(0));
    // The bar's upper side meets the corner (0.5, 9), whose direction is the bar's plus asin(0.1 /
    // r).
    const double radius = std::hypot(0.5, 9.0);
    const double angle = std::atan2(9.0, 0.5) - std::asin(0.1 / radius);
    EXPECT_NEAR(hit.time, angle / std::numbers::pi, 1e-8);
}

}  // namespace
}  // namespace nearfield::test
