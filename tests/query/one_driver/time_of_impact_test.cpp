#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/time_of_impact_check.hpp>
#include <tests/support/outlines.hpp>

#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

constexpr std::uint64_t time_of_impact_seed = 1414;

bool brackets_overlap(const TimeOfImpactResult& first, const TimeOfImpactResult& second) {
    constexpr double rounding = 1e-9;
    return first.time <= second.time + second.time_error_bound + rounding &&
           second.time <= first.time + first.time_error_bound + rounding;
}

TEST_F(TimeOfImpactTest, HoldsForRandomMotions) {
    int hits = 0;
    int separated = 0;
    for_each_case(time_of_impact_seed, 60, [&](Random& random) {
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
    for_each_case(time_of_impact_seed + 500, 40, [&](Random& random) {
        const MovingPair moving = any_moving_pair(random);
        const double size = std::max(moving.pair.tolerance, 0.01);
        const double distance = size * random.scale(1e-3, 30.0);
        const TimeOfImpactResult result = check(keeping(moving, distance), 30);
        hits += result.state == ImpactState::hit ? 1 : 0;
        started += result.state == ImpactState::intersecting_at_start ? 1 : 0;
        // A pair that comes within the larger distance later, or never, does not touch before.
        const TimeOfImpactResult touching = ask(moving);
        EXPECT_LE(result.time, touching.time + touching.time_error_bound);
    });
    EXPECT_GT(hits, random_cases(40) / 10);
    EXPECT_GT(started, 0);
}

TEST_F(TimeOfImpactTest, HoldsForEveryFamily) {
    for (Pair& pair : family_pairs(time_of_impact_seed)) {
        MovingPair moving{pair, pair.pose_a, pair.pose_b};
        moving.pair.pose_a.translation = {-40.0, 1.0};
        moving.end_a = {{30.0, -2.0}, moving.end_a.angle + 2.0};
        EXPECT_EQ(check(moving, 40).state, ImpactState::hit);
    }
}

TEST_F(TimeOfImpactTest, HoldsForDegeneratePolygons) {
    const std::vector<NamedRings> shapes = degenerate_shapes(context(), 40, time_of_impact_seed);
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

TEST_F(TimeOfImpactTest, LawsOfSymmetry) {
    for_each_case(time_of_impact_seed + 1000, 40, [&](Random& random) {
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
        // Reversed, the shapes are disjoint as well, or the last contact follows the first one.
        const TimeOfImpactResult back = ask(reversed(moving));
        if (result.state == ImpactState::separated) {
            EXPECT_EQ(back.state, ImpactState::separated);
        } else if (back.state == ImpactState::hit && result.state == ImpactState::hit) {
            EXPECT_LE(result.time + back.time, 1.0 + 1e-9);
        }
        // A finer answer is within a coarser one.
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
    query.time_bound = 0.0;
    expect_refused(query, "the time bound is 0");
    query.time_bound = 1.5;
    expect_refused(query, "the time bound is 1.5");
    query = good;
    query.max_steps = 0;
    expect_refused(query, "most steps");
    query = good;
    query.end_a.angle = std::numeric_limits<double>::infinity();
    expect_refused(query, "the angle of A's end pose");
    query = good;
    query.end_b.translation.y = std::nan("");
    expect_refused(query, "the y of B's end pose");
    query = good;
    query.end_a.angle = 1e15;
    expect_refused(query, "double precision");
}

}  // namespace
}  // namespace nearfield::test
