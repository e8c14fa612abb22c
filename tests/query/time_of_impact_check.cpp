#include <tests/oracle/plane.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/time_of_impact_check.hpp>

#include <cmath>

namespace nearfield::test {
namespace {

using oracle::ShapeOracle;

/// Contact must not be later than the true one, and distances not below the certified one.
void check_until_contact(const MovingPair& moving, const TimeOfImpactResult& result, int moments) {
    if (result.state == ImpactState::intersecting_at_start) {
        return;
    }
    for (int i = 0; i <= moments; ++i) {
        const double time = i == moments ? result.time : result.time * i / moments;
        const Moment moment(moving, time);
        const double distance = moment.boundary_distance();
        const double apart = moment.meets() ? 0.0 : distance;
        EXPECT_TRUE(distance <= result.error_bound || !moment.meets())
            << "late: they meet at " << time << " and are said to be apart until " << result.time;
        EXPECT_GE(apart, moving.contact_distance - result.error_bound)
            << "late: they touch at " << time << " and are said to be apart until " << result.time;
        EXPECT_GE(distance, result.min_distance) << "at " << time;
    }
}

void check_contact_time(const MovingPair& moving, const TimeOfImpactResult& result,
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

void check_closest_points(const MovingPair& moving, const TimeOfImpactResult& result) {
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

void check_start(const MovingPair& moving, const TimeOfImpactResult& result) {
    const Moment start(moving, 0.0);
    if (result.distance > 0.0) {
        EXPECT_FALSE(start.meets());
        EXPECT_LE(result.distance, moving.contact_distance + result.error_bound);
        check_closest_points(moving, result);
        return;
    }
    EXPECT_TRUE(start.meets() || start.boundary_distance() <= result.error_bound);
    for (const ShapeOracle* shape : {&start.a(), &start.b()}) {
        EXPECT_LE(shape->signed_distance(result.point_a), result.error_bound);
    }
}

}  // namespace

TimeOfImpactResult TimeOfImpactTest::ask(const MovingPair& moving, double time_bound,
                                         std::uint32_t max_steps) {
    const PlacedPair placed(context(), moving.pair, Technique::cpu);
    return run_alone(context(), TimeOfImpactQuery{placed.instance_a(), placed.instance_b(),
                                                  moving.end_a, moving.end_b, moving.pair.tolerance,
                                                  time_bound, max_steps, moving.contact_distance});
}

TimeOfImpactResult TimeOfImpactTest::check(const MovingPair& moving, int moments,
                                           double time_bound) {
    const CorpusKeeper keeper(moving.pair, moving.pair.tolerance);
    SCOPED_TRACE(describe(moving.pair));
    const TimeOfImpactResult result = ask(moving, time_bound);
    EXPECT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_EQ(result.technique, Technique::cpu);
    EXPECT_LE(result.error_bound, result.tolerance);
    EXPECT_GE(result.time, 0.0);
    EXPECT_LE(result.time, 1.0);
    check_until_contact(moving, result, moments);
    switch (result.state) {
        case ImpactState::intersecting_at_start:
            EXPECT_TRUE(result.intersects);
            EXPECT_EQ(result.time, 0.0);
            check_start(moving, result);
            break;
        case ImpactState::hit:
            check_contact_time(moving, result, time_bound);
            check_closest_points(moving, result);
            break;
        case ImpactState::separated:
            EXPECT_EQ(result.time, 1.0);
            EXPECT_EQ(result.time_error_bound, 0.0);
            EXPECT_FALSE(result.intersects);
            check_closest_points(moving, result);
            break;
        case ImpactState::bound_not_reached:
            ADD_FAILURE() << "the bound is not reached after " << result.steps << " steps";
    }
    return result;
}

}  // namespace nearfield::test
