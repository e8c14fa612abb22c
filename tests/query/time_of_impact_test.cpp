#include <tests/oracle/overlap.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/nasty_shapes.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::test {
namespace {

using oracle::ShapeOracle;

constexpr std::uint64_t seed = 1414;

/// Two shapes and where they move to.
struct MovingPair {
    Pair pair;
    Pose end_a;
    Pose end_b;
    double contact_distance = 0.0;
};

double between(double start, double end, double time) {
    return (1.0 - time) * start + time * end;
}

Pose pose_at_time(const Pose& start, const Pose& end, double time) {
    return {{between(start.translation.x, end.translation.x, time),
             between(start.translation.y, end.translation.y, time)},
            between(start.angle, end.angle, time)};
}

MovingPair swapped(const MovingPair& moving) {
    const Pair& pair = moving.pair;
    return {{pair.b, pair.a, pair.pose_b, pair.pose_a, pair.tolerance},
            moving.end_b,
            moving.end_a,
            moving.contact_distance};
}

MovingPair reversed(const MovingPair& moving) {
    const Pair& pair = moving.pair;
    return {{pair.a, pair.b, moving.end_a, moving.end_b, pair.tolerance},
            pair.pose_a,
            pair.pose_b,
            moving.contact_distance};
}

/// The same motion seen from elsewhere.
MovingPair moved_together(const MovingPair& moving, const Pose& by) {
    const auto move = [&](const Pose& pose) {
        const double cosine = std::cos(by.angle);
        const double sine = std::sin(by.angle);
        const auto& [x, y] = pose.translation;
        return Pose{
            {cosine * x - sine * y + by.translation.x, sine * x + cosine * y + by.translation.y},
            pose.angle + by.angle};
    };
    MovingPair result = moving;
    for (Pose* pose : {&result.pair.pose_a, &result.pair.pose_b, &result.end_a, &result.end_b}) {
        *pose = move(*pose);
    }
    return result;
}

/// What the oracle says of a time, by looking at the shapes then and at nothing else.
class Moment {
public:
    Moment(const MovingPair& moving, double time)
        : a_(moving.pair.a.rings, pose_at_time(moving.pair.pose_a, moving.end_a, time)),
          b_(moving.pair.b.rings, pose_at_time(moving.pair.pose_b, moving.end_b, time)) {}

    [[nodiscard]] const ShapeOracle& a() const { return a_; }
    [[nodiscard]] const ShapeOracle& b() const { return b_; }
    [[nodiscard]] bool meets() const { return oracle::intersects(a_, b_); }
    [[nodiscard]] double boundary_distance() const { return oracle::boundary_distance(a_, b_); }

private:
    ShapeOracle a_;
    ShapeOracle b_;
};

/// How far, at the most, a vertex of A and one of B move against each other between two times.
double relative_motion(const Moment& from, const Moment& to) {
    double most = 0.0;
    for (std::uint32_t i = 0; i < from.a().size(); ++i) {
        const Vector2 of_a = oracle::minus(to.a().vertex(i), from.a().vertex(i));
        for (std::uint32_t j = 0; j < from.b().size(); ++j) {
            const Vector2 of_b = oracle::minus(to.b().vertex(j), from.b().vertex(j));
            most = std::max(most, oracle::distance(of_a, of_b));
        }
    }
    return most;
}

class TimeOfImpactTest : public QueryTest {
protected:
    static TimeOfImpactResult ask(const MovingPair& moving, double time_bound = 1.0,
                                  std::uint32_t most_steps = TimeOfImpactQuery().most_steps) {
        const PlacedPair placed(context(), moving.pair, Technique::cpu);
        return run_alone(context(),
                         TimeOfImpactQuery{placed.instance_a(), placed.instance_b(), moving.end_a,
                                           moving.end_b, moving.pair.tolerance, time_bound,
                                           most_steps, moving.contact_distance});
    }

    /// What every answer promises, held against the oracle at `moments` times.
    static TimeOfImpactResult check(const MovingPair& moving, int moments = 60,
                                    double time_bound = 1.0) {
        const CorpusKeeper keeper(moving.pair, moving.pair.tolerance);
        SCOPED_TRACE(describe(moving.pair));
        const TimeOfImpactResult result = ask(moving, time_bound);
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_EQ(result.technique, Technique::cpu);
        EXPECT_LE(result.error_bound, result.tolerance);
        EXPECT_GE(result.time, 0.0);
        EXPECT_LE(result.time, 1.0);
        check_until(moving, result, moments);
        switch (result.state) {
            case ImpactState::intersecting_at_start:
                EXPECT_TRUE(result.intersects);
                EXPECT_EQ(result.time, 0.0);
                check_start(moving, result);
                break;
            case ImpactState::hit:
                check_hit(moving, result, time_bound);
                check_closest(moving, result);
                break;
            case ImpactState::separated:
                EXPECT_EQ(result.time, 1.0);
                EXPECT_EQ(result.time_error_bound, 0.0);
                EXPECT_FALSE(result.intersects);
                check_closest(moving, result);
                break;
            case ImpactState::bound_not_reached:
                ADD_FAILURE() << "the bound is not reached after " << result.steps << " steps";
        }
        return result;
    }

private:
    /// Never late, and never closer than certified.
    static void check_until(const MovingPair& moving, const TimeOfImpactResult& result,
                            int moments) {
        if (result.state == ImpactState::intersecting_at_start) {
            return;
        }
        for (int i = 0; i <= moments; ++i) {
            const double time = i == moments ? result.time : result.time * i / moments;
            const Moment moment(moving, time);
            const double distance = moment.boundary_distance();
            const double apart = moment.meets() ? 0.0 : distance;
            EXPECT_TRUE(distance <= result.error_bound || !moment.meets())
                << "late: they meet at " << time << " and are said to be apart until "
                << result.time;
            EXPECT_GE(apart, moving.contact_distance - result.error_bound)
                << "late: they touch at " << time << " and are said to be apart until "
                << result.time;
            EXPECT_GE(distance, result.least_distance) << "at " << time;
        }
    }
    static void check_hit(const MovingPair& moving, const TimeOfImpactResult& result,
                          double time_bound) {
        EXPECT_LE(result.time_error_bound, time_bound);
        const Moment first(moving, result.time);
        bool met = false;
        for (int i = 0; i <= 16 && !met; ++i) {
            const Moment moment(moving, result.time + result.time_error_bound * i / 16);
            EXPECT_LE(relative_motion(first, moment),
                      result.tolerance * (1.0 + 1e-9) + 4.0 * result.error_bound);
            met = moment.meets() ||
                  moment.boundary_distance() <= moving.contact_distance + result.error_bound;
        }
        EXPECT_TRUE(met) << "early: from " << result.time << " for " << result.time_error_bound;
    }
    static void check_closest(const MovingPair& moving, const TimeOfImpactResult& result) {
        const Moment moment(moving, result.time);
        const double allowed = result.error_bound;
        EXPECT_NEAR(result.distance, moment.boundary_distance(), allowed);
        EXPECT_LE(moment.a().nearest(result.point_a).distance, allowed);
        EXPECT_LE(moment.b().nearest(result.point_b).distance, allowed);
        const Vector2 reached =
            oracle::plus(result.point_a, oracle::times(result.direction, result.distance));
        EXPECT_LE(oracle::distance(reached, result.point_b), allowed);
        const Pose& pose = result.pose_a;
        const Pose expected = pose_at_time(moving.pair.pose_a, moving.end_a, result.time);
        EXPECT_NEAR(pose.translation.x, expected.translation.x, allowed);
        EXPECT_NEAR(pose.translation.y, expected.translation.y, allowed);
        EXPECT_NEAR(pose.angle, expected.angle, 1e-12 * (1.0 + std::abs(expected.angle)));
    }
    static void check_start(const MovingPair& moving, const TimeOfImpactResult& result) {
        const Moment start(moving, 0.0);
        if (result.distance > 0.0) {
            EXPECT_FALSE(start.meets());
            EXPECT_LE(result.distance, moving.contact_distance + result.error_bound);
            check_closest(moving, result);
            return;
        }
        EXPECT_TRUE(start.meets() || start.boundary_distance() <= result.error_bound);
        for (const ShapeOracle* shape : {&start.a(), &start.b()}) {
            EXPECT_LE(shape->signed_distance(result.point_a), result.error_bound);
        }
    }
};

/// Shapes of any family, apart by more or less, that cross each other's ways and turn.
MovingPair any_moving_pair(Random& random) {
    MovingPair moving{any_pair(random), {}, {}};
    Pair& pair = moving.pair;
    const double size = pair.tolerance * 40.0;
    const auto step = [&](const Pose& from, double far) {
        const double turn =
            random.whole(0, 3) == 0 ? random.between(-40.0, 40.0) : random.between(-1.0, 1.0);
        return Pose{{from.translation.x + far * random.between(-size, size),
                     from.translation.y + far * random.between(-size, size)},
                    from.angle + turn};
    };
    const Pose met = pair.pose_a;
    pair.pose_a = step(met, 3.0);
    moving.end_a = step(met, 2.0);
    moving.end_b = random.whole(0, 1) == 0 ? pair.pose_b : step(pair.pose_b, 1.0);
    pair.tolerance *= random.scale(0.001, 1.0);
    return moving;
}

MovingPair falling(const Rings& a, const Rings& b, const Pose& start, const Pose& end,
                   double tolerance) {
    return {{{"A", a}, {"B", b}, start, {}, tolerance}, end, {}};
}

/// To come that close is to touch.
MovingPair keeping(MovingPair moving, double contact_distance) {
    moving.contact_distance = contact_distance;
    return moving;
}

bool brackets_overlap(const TimeOfImpactResult& first, const TimeOfImpactResult& second) {
    constexpr double rounding = 1e-9;
    return first.time <= second.time + second.time_error_bound + rounding &&
           second.time <= first.time + first.time_error_bound + rounding;
}

TEST_F(TimeOfImpactTest, HoldsForRandomMotions) {
    int hits = 0;
    int separated = 0;
    for_each_case(seed, 60, [&](Random& random) {
        const TimeOfImpactResult result = check(any_moving_pair(random), 30);
        hits += result.state == ImpactState::hit ? 1 : 0;
        separated += result.state == ImpactState::separated ? 1 : 0;
    });
    EXPECT_GT(hits, random_cases(60) / 10);
    EXPECT_GT(separated, random_cases(60) / 20);
}

TEST_F(TimeOfImpactTest, HoldsForRandomMotionsThatKeepADistance) {
    int hits = 0;
    int started = 0;
    for_each_case(seed + 500, 40, [&](Random& random) {
        const MovingPair moving = any_moving_pair(random);
        const double size = std::max(moving.pair.tolerance, 0.01);
        const double distance = size * random.scale(1e-3, 30.0);
        const TimeOfImpactResult result = check(keeping(moving, distance), 30);
        hits += result.state == ImpactState::hit ? 1 : 0;
        started += result.state == ImpactState::intersecting_at_start ? 1 : 0;
        // Who comes as close as that later or not at all does not touch before.
        const TimeOfImpactResult touching = ask(moving);
        EXPECT_LE(result.time, touching.time + touching.time_error_bound);
    });
    EXPECT_GT(hits, random_cases(40) / 10);
    EXPECT_GT(started, 0);
}

TEST_F(TimeOfImpactTest, HoldsForEveryFamily) {
    for (Pair& pair : family_pairs(seed)) {
        MovingPair moving{pair, pair.pose_a, pair.pose_b};
        moving.pair.pose_a.translation = {-40.0, 1.0};
        moving.end_a = {{30.0, -2.0}, moving.end_a.angle + 2.0};
        EXPECT_EQ(check(moving, 40).state, ImpactState::hit);
    }
}

TEST_F(TimeOfImpactTest, HoldsForNastyPolygons) {
    const std::vector<NamedRings> shapes = nasty_shapes(context(), 40, seed);
    int hits = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const MovingPair moving{
            {shapes[i], shapes[(i + 5) % shapes.size()], {{-300.0, 3.0}, 0.0}, {}, 0.05},
            {{200.0, -5.0}, 1.0},
            {{1.0, 2.0}, -0.5}};
        hits += check(moving, 30).state == ImpactState::hit ? 1 : 0;
    }
    EXPECT_GE(hits, 3);
}

TEST_F(TimeOfImpactTest, OutlinesMeetOnTheWay) {
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const MovingPair moving{
            {outlines[i], outlines[(i + 1) % outlines.size()], {{-1500.0, 20.0}, 0.0}, {}, 0.5},
            {{1000.0, -20.0}, 1.0},
            {}};
        EXPECT_EQ(check(moving, 8).state, ImpactState::hit) << outlines[i].name;
    }
}

TEST_F(TimeOfImpactTest, KnownTimes) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const Rings floor = rectangle({-50, -2}, {50, 0});
    // From a height of 4 down to -4: its lower edge, 1 lower, is on the floor after 3/8.
    TimeOfImpactResult result = check(falling(square, floor, {{0, 4}, 0}, {{0, -4}, 0}, 1e-6));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 0.375, 1e-6 / 8.0);
    EXPECT_LE(result.time, 0.375);
    EXPECT_NEAR(result.direction.y, -1.0, 1e-12);
    // Turned by an eighth it is sqrt 2 high, and again and again.
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
    // Tighter than times can be told apart.
    result = check(falling(square, floor, {{0, 4}, 0}, {{0, -4}, 0}, 0.1), 60, 1e-17);
    EXPECT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 0.375, 1e-12);
}

TEST_F(TimeOfImpactTest, KnownTimesAtADistance) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const Rings floor = rectangle({-50, -2}, {50, 0});
    const MovingPair fall = falling(square, floor, {{0, 4}, 0}, {{0, -4}, 0}, 1e-6);
    // 3 above the floor at first, 8 lower at the end.
    TimeOfImpactResult result = check(keeping(fall, 0.5));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 2.5 / 8.0, 1e-6 / 8.0);
    EXPECT_NEAR(result.distance, 0.5, 1e-6);
    EXPECT_GE(result.distance, 0.5);
    EXPECT_GE(result.least_distance, 0.5 - result.error_bound);
    EXPECT_NEAR(result.direction.y, -1.0, 1e-12);
    // Closer than that already, and as close.
    result = check(keeping(fall, 3.5));
    EXPECT_EQ(result.state, ImpactState::intersecting_at_start);
    EXPECT_EQ(result.distance, 3.0);
    EXPECT_EQ(check(keeping(fall, 3.0)).state, ImpactState::intersecting_at_start);
    // Through the floor and far below it: never seen as far apart.
    result = check(keeping(falling(square, floor, {{0, 4}, 0}, {{0, -40}, 0}, 1e-3), 0.1));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_NEAR(result.time, 2.9 / 44.0, 1e-3 / 44.0);
    // It slides along at a little more than the distance, and at a little less.
    const auto slide = [&](double gap) {
        return keeping(falling(square, floor, {{-30, 1.0 + gap}, 0}, {{30, 1.0 + gap}, 0}, 1e-3),
                       0.25);
    };
    result = check(slide(0.25 + 1e-9));
    EXPECT_EQ(result.state, ImpactState::separated);
    EXPECT_GE(result.least_distance, 0.25);
    EXPECT_LT(result.steps, 20U);
    EXPECT_EQ(check(slide(0.25 - 1e-9)).state, ImpactState::intersecting_at_start);
    // A corner that passes another at the distance or less, slanting.
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
    EXPECT_GE(spun.least_distance, (1.5 - std::numbers::sqrt2) / 8.0 - 1e-9);
}

TEST_F(TimeOfImpactTest, SwingingRoundAndBackIsSeen) {
    // On an arm of 3 a small square goes round: as far from the wall at the end as at the start,
    // and much closer in between.
    const Rings weight = rectangle({-3.1, -0.1}, {-2.9, 0.1});
    const Rings wall = rectangle({0, -9}, {1, 9});
    for (const double gap : {0.5, 4.0, 40.0}) {
        const double origin = -3.1 - gap;
        const TimeOfImpactResult result = check(
            falling(weight, wall, {{origin, 0}, 0}, {{origin, 0}, 2.0 * std::numbers::pi}, 1e-3),
            100);
        EXPECT_EQ(result.state, ImpactState::separated) << gap;
        EXPECT_GE(result.least_distance, gap / 8.0 - 0.01) << gap;
    }
}

TEST_F(TimeOfImpactTest, StartingInEachOther) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    for (const double shift : {0.0, 1.5, 2.0}) {
        const TimeOfImpactResult result =
            check(falling(square, square, {{shift, 0}, 0}, {{9, 0}, 0}, 1e-3));
        EXPECT_EQ(result.state, ImpactState::intersecting_at_start) << shift;
    }
    // Nearly: whatever is said, it is said of time 0.
    for (const double gap : {1e-16, 1e-15, 3e-15, 1e-14, 3e-14, 1e-13}) {
        const TimeOfImpactResult result =
            check(falling(square, square, {{2.0 + gap, 0.5}, 0}, {{1.0, 0.5}, 0}, 1e-3));
        EXPECT_NE(result.state, ImpactState::separated) << gap;
        EXPECT_LE(result.time, gap) << gap;
        EXPECT_LE(result.least_distance, gap) << gap;
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
        EXPECT_LE(result.least_distance, gap);
        EXPECT_GE(result.least_distance, gap / 8.0 - 1e-12);
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
    // Past it at the end, so whether they touch on the way is not known.
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

TEST_F(TimeOfImpactTest, LawsOfSymmetry) {
    for_each_case(seed + 1000, 40, [&](Random& random) {
        const MovingPair moving = any_moving_pair(random);
        SCOPED_TRACE(describe(moving.pair));
        const TimeOfImpactResult result = ask(moving);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        const TimeOfImpactResult other = ask(swapped(moving));
        EXPECT_EQ(other.state, result.state) << "A and B swapped";
        EXPECT_TRUE(brackets_overlap(result, other)) << "A and B swapped";
        const TimeOfImpactResult seen = ask(moved_together(moving, {{3.0, -2.0}, 0.7}));
        EXPECT_EQ(seen.state, result.state) << "seen from elsewhere";
        EXPECT_TRUE(brackets_overlap(result, seen)) << "seen from elsewhere";
        // Backwards they are apart as well, or the last contact comes after the first one.
        const TimeOfImpactResult back = ask(reversed(moving));
        if (result.state == ImpactState::separated) {
            EXPECT_EQ(back.state, ImpactState::separated);
        } else if (back.state == ImpactState::hit && result.state == ImpactState::hit) {
            EXPECT_LE(result.time + back.time, 1.0 + 1e-9);
        }
        // A finer answer lies in a coarser one.
        MovingPair coarser = moving;
        coarser.pair.tolerance *= 10.0;
        const TimeOfImpactResult coarse = ask(coarser);
        EXPECT_EQ(coarse.state, result.state) << "coarser";
        EXPECT_TRUE(brackets_overlap(result, coarse)) << "coarser";
    });
}

TEST_F(TimeOfImpactTest, RefusesWhatItCannotUse) {
    const PlacedPair pair(
        context(),
        {{"A", rectangle({0, 0}, {1, 1})}, {"B", rectangle({3, 0}, {4, 1})}, {}, {}, 0.1});
    const TimeOfImpactQuery good{pair.instance_a(), pair.instance_b(), {{5, 0}, 0}, {}, 0.1};
    EXPECT_EQ(run_alone(context(), good).state, ImpactState::hit);
    const auto expect_refused = [](const TimeOfImpactQuery& query, const std::string& what) {
        const Status status = run_alone(context(), query).status;
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_NE(status.message().find(what), std::string::npos) << status.text();
    };
    TimeOfImpactQuery query = good;
    query.technique = Technique::compute;
    expect_refused(query, "compute does not answer times of impact");
    query = good;
    query.tolerance = 0.0;
    expect_refused(query, "tolerance");
    query.tolerance = 1e-14;
    expect_refused(query, "double precision");
    query = good;
    query.time_bound = 0.0;
    expect_refused(query, "the time bound is 0");
    query.time_bound = 1.5;
    expect_refused(query, "the time bound is 1.5");
    query = good;
    query.most_steps = 0;
    expect_refused(query, "most steps");
    query = good;
    for (const double distance : {-0.1, std::nan(""), 1e300}) {
        query.contact_distance = distance;
        expect_refused(query, "the contact distance is");
    }
    query = good;
    query.end_a.angle = std::numeric_limits<double>::infinity();
    expect_refused(query, "the angle of A's end pose");
    query = good;
    query.end_b.translation.y = std::nan("");
    expect_refused(query, "the y of B's end pose");
    query = good;
    query.a.pose.translation.x = 1e300;
    expect_refused(query, "the x of A's pose");
    query = good;
    query.end_a.angle = 1e15;
    expect_refused(query, "double precision");
    query = good;
    query.b = {};
    EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::unknown_shape);
}

}  // namespace
}  // namespace nearfield::test
