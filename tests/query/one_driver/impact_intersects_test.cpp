#include <tests/query/time_of_impact_check.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

constexpr std::uint64_t impact_intersects_seed = 1210;

/// How deep a vertex of either shape is in the other; below 0 where none is inside.
double depth(const Moment& moment) {
    double most = -1e300;
    for (std::uint32_t i = 0; i < moment.a().size(); ++i) {
        most = std::max(most, moment.b().depth(moment.a().vertex(i)));
    }
    for (std::uint32_t i = 0; i < moment.b().size(); ++i) {
        most = std::max(most, moment.a().depth(moment.b().vertex(i)));
    }
    return most;
}

/// What `intersects` of a hit says: they touch at the end of the interval that is left open.
bool check_intersects(const MovingPair& moving, const TimeOfImpactResult& result) {
    const Moment latest(moving, result.time + result.time_error_bound);
    if (result.intersects) {
        EXPECT_TRUE(latest.meets() ||
                    latest.boundary_distance() <= moving.contact_distance + result.error_bound)
            << "said to touch at " << result.time + result.time_error_bound;
    } else {
        EXPECT_LE(depth(latest), result.error_bound)
            << "said not to touch at " << result.time + result.time_error_bound;
    }
    return result.intersects;
}

TEST_F(TimeOfImpactTest, AHitIntersectsWhereTheShapesWereFoundToTouch) {
    int hits = 0;
    int intersecting = 0;
    for_each_case(impact_intersects_seed, 300, [&](Random& random) {
        MovingPair moving = any_moving_pair(random);
        if (random.whole(0, 2) == 0) {
            moving = keeping(moving, 0.05);
        }
        SCOPED_TRACE(describe(moving.pair));
        const TimeOfImpactResult result = ask(moving);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        if (result.state == ImpactState::hit) {
            ++hits;
            intersecting += check_intersects(moving, result) ? 1 : 0;
        } else {
            EXPECT_EQ(result.intersects, result.state == ImpactState::intersecting_at_start);
        }
    });
    EXPECT_GT(hits, random_cases(300) / 10);
    EXPECT_GT(intersecting, hits / 2);
}

TEST_F(TimeOfImpactTest, AHitThatOnlyRoundingSeesDoesNotIntersect) {
    const Rings square = rectangle({-1, -1}, {1, 1});
    const Rings floor = rectangle({-50, -2}, {50, 0});
    // Its lower edge ends above the floor, which it never reaches, by less than what rounding may
    // make of it.
    const double end = 1.0 + 3e-13;
    TimeOfImpactResult result = ask(falling(square, floor, {{0, 4}, 0}, {{0, end}, 0}, 1e-3));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_GT(result.error_bound, 3e-13);
    EXPECT_FALSE(result.intersects);
    EXPECT_NEAR(result.time + result.time_error_bound, 1.0, 1e-3);
    result = ask(falling(square, floor, {{0, 4}, 0}, {{0, 0.5}, 0}, 1e-3));
    ASSERT_EQ(result.state, ImpactState::hit);
    EXPECT_TRUE(result.intersects);
}

}  // namespace
}  // namespace nearfield::test
