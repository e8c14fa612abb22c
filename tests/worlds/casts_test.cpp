#include "scene.hpp"

#include <gtest/gtest.h>
#include <tests/support/numbers.hpp>

#include <cmath>

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

using WorldCasts = ScenesTest;

TEST_P(WorldCasts, AreTheEarliestTimeOfImpact) {
    for_each_scene(2, 57, [](Scene& scene, Random& random) {
        const Rectangle box = scene.box();
        ShapeCastQuery query;
        query.shape = scene.add_shape(scaled_and_moved(star(random, random.whole(3, 40), 0.3),
                                                       random.scale(0.02, 1.0),
                                                       {random.between(-1.0, 1.0), 0.0}));
        const WorldOptions options{.filter = any_filter(random, scene)};
        query.tolerance = random.scale(1e-11, 1e-9) * size_of(GetParam(), box);
        query.contact_distance = random.whole(0, 1) == 0 ? 0.0 : random.scale(1e-3, 0.3);
        const std::vector<Sweep> sweeps = any_sweeps(random, scene, box, 10);
        std::vector<ShapeCastHit> hits(sweeps.size());
        const Status status = scene.world().cast_shape(query, sweeps, hits, options);
        ASSERT_TRUE(status.ok()) << status.text();
        for (std::size_t i = 0; i < sweeps.size() && !HasFailure(); ++i) {
            SCOPED_TRACE("sweep " + std::to_string(i));
            EXPECT_EQ(numbers_of(hits[i]),
                      numbers_of(earliest(scene, query, options.filter, sweeps[i])));
            check_never_late(scene, query, options, sweeps[i], hits[i]);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldCasts, testing::ValuesIn(all_scene_kinds()));

TEST(WorldCastsOfSquares, ComeWithinTheContactDistanceBesideTheirPath) {
    Scene scene(unit_squares({{4.0, 1.25}}));
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

}  // namespace
}  // namespace nearfield::test
