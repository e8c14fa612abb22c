#include <tests/query/time_of_impact_check.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::test {
namespace {

TEST_F(TimeOfImpactTest, KnownTimes) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const Rings floor = rectangle({-50, -2}, {50, 0});
    // From a height of 4 down to -4: its lower edge, 1 lower, reaches the floor after 3/8.
    TimeOfImpactResult result = check(falling(square, floor, {{0, 4}, 0}, {{0, -4}, 0}, 1e-6));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 0.375, 1e-6 / 8.0);
    EXPECT_LE(result.time, 0.375);
    EXPECT_NEAR(result.direction.y, -1.0, 1e-12);
    // Rotated by an eighth turn it is sqrt 2 high, repeatedly.
    const double turns = 5.0 * std::numbers::pi / 2.0;
    result = check(falling(square, floor, {{0, 1.2}, 0}, {{0, 1.2}, turns}, 1e-6));
    ASSERT_EQ(result.state, ImpactState::hit);
    // sqrt 2 * sin(45 degrees + angle) = 1.2
    const double angle = std::asin(1.2 / std::numbers::sqrt2) - std::numbers::pi / 4.0;
    EXPECT_NEAR(result.time, angle / turns, 1e-6);
    // A tighter bound on the time.
    result = check(falling(square, floor, {{0, 4}, 0}, {{0, -4}, 0}, 0.1), 60, 1e-9);
    EXPECT_LE(result.time_error_bound, 1e-9);
    EXPECT_NEAR(result.time, 0.375, 1e-9);
    // Tighter than the resolution of times.
    result = check(falling(square, floor, {{0, 4}, 0}, {{0, -4}, 0}, 0.1), 60, 1e-17);
    EXPECT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 0.375, 1e-12);
}

TEST_F(TimeOfImpactTest, KnownTimesAtADistance) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const Rings floor = rectangle({-50, -2}, {50, 0});
    const MovingPair fall = falling(square, floor, {{0, 4}, 0}, {{0, -4}, 0}, 1e-6);
    // Initially 3 above the floor, 8 lower at the end.
    TimeOfImpactResult result = check(keeping(fall, 0.5));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 2.5 / 8.0, 1e-6 / 8.0);
    EXPECT_NEAR(result.distance, 0.5, 1e-6);
    EXPECT_GE(result.distance, 0.5);
    EXPECT_GE(result.min_distance, 0.5 - result.error_bound);
    EXPECT_NEAR(result.direction.y, -1.0, 1e-12);
    // Initially closer than that, and exactly as close.
    result = check(keeping(fall, 3.5));
    EXPECT_EQ(result.state, ImpactState::intersecting_at_start);
    EXPECT_EQ(result.distance, 3.0);
    EXPECT_EQ(check(keeping(fall, 3.0)).state, ImpactState::intersecting_at_start);
    // Through the floor to far below it: never observed at that distance.
    result = check(keeping(falling(square, floor, {{0, 4}, 0}, {{0, -40}, 0}, 1e-3), 0.1));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 2.9 / 44.0, 1e-3 / 44.0);
    // It slides along slightly above the contact distance, and slightly below.
    const auto slide = [&](double gap) {
        return keeping(falling(square, floor, {{-30, 1.0 + gap}, 0}, {{30, 1.0 + gap}, 0}, 1e-3),
                       0.25);
    };
    result = check(slide(0.25 + 1e-9));
    EXPECT_EQ(result.state, ImpactState::separated);
    EXPECT_GE(result.min_distance, 0.25);
    EXPECT_LT(result.steps, 20U);
    EXPECT_EQ(check(slide(0.25 - 1e-9)).state, ImpactState::intersecting_at_start);
    // A corner that passes another obliquely within the distance.
    const Rings corner{{{0, 0}, {-3, 1}, {-3, -1}}};
    const auto pass = [&](double by) {
        return keeping(falling(square, corner, {{1.0 + by, 9}, 0}, {{1.0 + by, -9}, 0}, 1e-5), 0.3);
    };
    EXPECT_EQ(check(pass(0.3 + 1e-6)).state, ImpactState::separated);
    EXPECT_EQ(check(pass(0.3 - 1e-6)).state, ImpactState::hit);
}

TEST_F(TimeOfImpactTest, InsideAHoleTheWallIsHit) {
    const Rings frame{rectangle({-5, -5}, {5, 5})[0], rectangle({-4, -4}, {4, 4})[0]};
    const Rings square = rectangle({-1, -1}, {1, 1});
    const TimeOfImpactResult result = check(falling(square, frame, {}, {{12, 0}, 0}, 1e-3));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 0.25, 1e-3);
    EXPECT_EQ(check(falling(square, frame, {}, {{2.9, 0}, 0}, 1e-3)).state, ImpactState::separated);
    // Many turns in a hole that is just wide enough.
    const Rings wide{rectangle({-5, -5}, {5, 5})[0], rectangle({-1.5, -1.5}, {1.5, 1.5})[0]};
    const TimeOfImpactResult spun = check(falling(square, wide, {}, {{0, 0}, 200.0}, 1e-3), 400);
    EXPECT_EQ(spun.state, ImpactState::separated);
    EXPECT_GE(spun.min_distance, (1.5 - std::numbers::sqrt2) / 8.0 - 1e-9);
}

TEST_F(TimeOfImpactTest, SwingingRoundAndBackIsSeen) {
    // A small square revolves on an arm of length 3: as far from the wall at the end as at the
    // start, and much closer in between.
    const Rings weight = rectangle({-3.1, -0.1}, {-2.9, 0.1});
    const Rings wall = rectangle({0, -9}, {1, 9});
    for (const double gap : {0.5, 4.0, 40.0}) {
        const double origin = -3.1 - gap;
        const TimeOfImpactResult result = check(
            falling(weight, wall, {{origin, 0}, 0}, {{origin, 0}, 2.0 * std::numbers::pi}, 1e-3),
            100);
        EXPECT_EQ(result.state, ImpactState::separated) << gap;
        EXPECT_GE(result.min_distance, gap / 8.0 - 0.01) << gap;
    }
}

TEST_F(TimeOfImpactTest, StartingInEachOther) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    for (const double shift : {0.0, 1.5, 2.0}) {
        const TimeOfImpactResult result =
            check(falling(square, square, {{shift, 0}, 0}, {{9, 0}, 0}, 1e-3));
        EXPECT_EQ(result.state, ImpactState::intersecting_at_start) << shift;
    }
    // Nearly touching: any contact is reported at time 0.
    for (const double gap : {1e-16, 1e-15, 3e-15, 1e-14, 3e-14, 1e-13}) {
        const TimeOfImpactResult result =
            check(falling(square, square, {{2.0 + gap, 0.5}, 0}, {{1.0, 0.5}, 0}, 1e-3));
        EXPECT_NE(result.state, ImpactState::separated) << gap;
        EXPECT_LE(result.time, gap) << gap;
        EXPECT_LE(result.min_distance, gap) << gap;
    }
    const Rings large = rectangle({-5, -5}, {5, 5});
    EXPECT_EQ(check(falling(square, large, {}, {{9, 0}, 0}, 1e-3)).state,
              ImpactState::intersecting_at_start);
}

TEST_F(TimeOfImpactTest, NearMissesAndSlidingTakeFewSteps) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const Rings floor = rectangle({-50, -2}, {50, 0});
    for (const double gap : {1e-2, 1e-6, 1e-9}) {
        TimeOfImpactResult result =
            check(falling(square, floor, {{-30, 1 + gap}, 0}, {{30, 1 + gap}, 0}, 1e-3));
        EXPECT_EQ(result.state, ImpactState::separated);
        EXPECT_LE(result.min_distance, gap);
        EXPECT_GE(result.min_distance, gap / 8.0 - 1e-12);
        EXPECT_LT(result.steps, 20U);
        // A disc passes a tip.
        result = check(falling(regular(64), {{{-1, -5}, {1, -5}, {0, 0}}}, {{-9, 1 + gap}, 0},
                               {{9, 1 + gap}, 0}, 1e-3));
        EXPECT_EQ(result.state, ImpactState::separated);
        EXPECT_LT(result.steps, 200U);
        // As far into the floor instead.
        result = check(falling(regular(64), floor, {{-9, 3}, 0}, {{9, 1 - gap}, 0}, 1e-3));
        EXPECT_EQ(result.state, ImpactState::hit);
    }
}

TEST_F(TimeOfImpactTest, TooFewStepsAreFlagged) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const Rings floor = rectangle({-50, -2}, {50, 0});
    const MovingPair deep = falling(square, floor, {{0, 4}, 0}, {{3, -0.5}, 20.0}, 1e-6);
    const MovingPair through = falling(square, floor, {{0, 4}, 0}, {{3, -9}, 20.0}, 1e-6);
    const TimeOfImpactResult full = check(deep);
    ASSERT_EQ(full.state, ImpactState::hit);
    for (std::uint32_t steps = 1; steps < full.steps - 1; ++steps) {
        const TimeOfImpactResult result = ask(deep, 1.0, steps);
        ASSERT_EQ(result.state, ImpactState::bound_not_reached) << steps;
        EXPECT_LE(result.time, full.time + full.time_error_bound);
        EXPECT_TRUE(result.intersects);
        EXPECT_NEAR(result.time + result.time_error_bound, 1.0, 1e-12);
    }
    // It has passed at the end, so whether the shapes touch on the way is unknown.
    const TimeOfImpactResult result = ask(through, 1.0, 2);
    EXPECT_EQ(result.state, ImpactState::bound_not_reached);
    EXPECT_FALSE(result.intersects);
    EXPECT_NEAR(result.time + result.time_error_bound, 1.0, 1e-12);
}

TEST_F(TimeOfImpactTest, StandingStillStaysApart) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const TimeOfImpactResult result =
        check(falling(square, square, {{2.5, 0}, 0}, {{2.5, 0}, 0}, 1e-3));
    EXPECT_EQ(result.state, ImpactState::separated);
    EXPECT_EQ(result.distance, 0.5);
    EXPECT_EQ(result.steps, 2U);
}

}  // namespace
}  // namespace nearfield::test
