#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::test {
namespace {

constexpr std::uint64_t placement_seed = 360;

class Placement : public QueryTest {
protected:
    static void check_moved(Technique technique);
};

/// `pose` followed by a rigid motion of the world.
Pose moved(const Pose& pose, const Pose& motion) {
    const double cosine = std::cos(motion.angle);
    const double sine = std::sin(motion.angle);
    const Vector2& t = pose.translation;
    return {{cosine * t.x - sine * t.y + motion.translation.x,
             sine * t.x + cosine * t.y + motion.translation.y},
            pose.angle + motion.angle};
}

void Placement::check_moved(Technique technique) {
    Random random(placement_seed);
    for (const Pair& pair : family_pairs(placement_seed)) {
        const Pose motion{{random.between(-1e6, 1e6), random.between(-1e6, 1e6)},
                          random.between(-4.0, 4.0)};
        Pair elsewhere = pair;
        elsewhere.pose_a = moved(pair.pose_a, motion);
        elsewhere.pose_b = moved(pair.pose_b, motion);
        SCOPED_TRACE(describe(pair) + "\nmoved to\n" + describe(elsewhere));
        const PlacedPair here(context(), pair, technique);
        const PlacedPair there(context(), elsewhere, technique);
        for (const auto points : {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            const auto before = run_alone(context(), here.penetration(points));
            const auto after = run_alone(context(), there.penetration(points));
            ASSERT_TRUE(before.status.ok() && after.status.ok());
            EXPECT_EQ(before.intersects, after.intersects);
            const bool vertices = points == PenetrationPoints::vertices;
            const double slack = vertices ? 1.0 : 4.0 + before.count / 20.0;
            EXPECT_NEAR(before.count, after.count, slack);
            if (before.count > 0 && after.count > 0) {
                EXPECT_NEAR(before.deepest.depth, after.deepest.depth,
                            before.error_bound + after.error_bound + 1e-6);
            }
        }
    }
}

TEST_F(Placement, MovingBothChangesNothing) {
    check_moved(Technique::raster);
}

TEST_F(Placement, MovingBothChangesNothingForTheComputeTechnique) {
    check_moved(Technique::compute);
}

TEST_F(Placement, ContainmentIsFoundBothWays) {
    Random random(placement_seed);
    const NamedRings big{"big", scaled_and_moved(star(random, 50, 0.8), 10.0, {})};
    const NamedRings small{"small", star(random, 30, 0.5)};
    const PlacedPair inner(context(), {small, big, {{1.0, 2.0}, 0.4}, {}, 0.05});
    const auto inside = run_alone(context(), inner.penetration());
    check_penetration(inner, PenetrationPoints::boundary, inside);
    EXPECT_TRUE(inside.intersects);
    EXPECT_GT(inside.count, 30U);
    const PlacedPair outer(context(), {big, small, {}, {{1.0, 2.0}, 0.4}, 0.05});
    const auto around = run_alone(context(), outer.penetration());
    check_penetration(outer, PenetrationPoints::boundary, around);
    EXPECT_TRUE(around.intersects);
    EXPECT_EQ(around.count, 0U);
    const auto area = run_alone(context(), outer.intersection(IntersectionKind::volume_volume));
    check_intersection(outer, IntersectionKind::volume_volume, area);
    EXPECT_GT(area.count, 0U);
}

TEST_F(Placement, AShapeInAHoleIsApart) {
    Rings frame = rectangle({-9, -9}, {9, 9});
    frame.push_back(rectangle({-3, -3}, {3, 3})[0]);
    const PlacedPair pair(context(),
                          {{"in", rectangle({-2, -2}, {2, 2})}, {"frame", frame}, {}, {}, 0.1});
    const auto result = run_alone(context(), pair.penetration());
    check_penetration(pair, PenetrationPoints::boundary, result);
    EXPECT_FALSE(result.intersects);
    EXPECT_EQ(result.count, 0U);
    const auto kind = IntersectionKind::volume_volume;
    const auto both = run_alone(context(), pair.intersection(kind));
    check_intersection(pair, kind, both);
    EXPECT_EQ(both.count, 0U);
}

TEST_F(Placement, FarApartIsEmptyAndHasNoRegions) {
    Random random(placement_seed);
    const NamedRings shape{"star", star(random, 80, 0.3)};
    for (const double away : {3.0, 1e3, 1e9}) {
        const PlacedPair pair(context(), {shape, shape, {}, {{away, away / 2}, 1.0}, 0.05});
        for (const auto points : {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            const auto result = run_alone(context(), pair.penetration(points));
            ASSERT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_FALSE(result.intersects);
            EXPECT_EQ(result.count, 0U);
            EXPECT_TRUE(result.points.empty());
            EXPECT_TRUE(result.regions.empty());
        }
        for (const auto kind :
             {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
              IntersectionKind::volume_volume}) {
            const auto result = run_alone(context(), pair.intersection(kind));
            ASSERT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_FALSE(result.intersects);
            EXPECT_EQ(result.count, 0U);
            EXPECT_EQ(result.area, 0.0);
            EXPECT_TRUE(result.regions.empty());
        }
    }
}

}  // namespace
}  // namespace nearfield::test
