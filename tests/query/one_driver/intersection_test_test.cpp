#include <tests/query/check.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::test {
namespace {

constexpr std::uint64_t intersection_test_seed = 3141;

class IntersectionTest : public QueryTest {
protected:
    static bool ask(const Instance& a, const Instance& b) {
        const IntersectionTestResult result = run_alone(context(), IntersectionTestQuery{a, b});
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_EQ(result.technique, Technique::cpu);
        EXPECT_EQ(result.tolerance, 0.0);
        EXPECT_TRUE(result.regions.empty());
        EXPECT_GE(result.error_bound, 0.0);
        return result.intersects;
    }
    /// Checks both orders against the oracle and against the separation.
    static bool check(Pair pair) {
        const PlacedPair placed(context(), std::move(pair), Technique::cpu);
        const CorpusKeeper keeper(placed.pair(), placed.tolerance());
        SCOPED_TRACE(describe(placed.pair()));
        const bool meets = ask(placed.instance_a(), placed.instance_b());
        EXPECT_EQ(ask(placed.instance_b(), placed.instance_a()), meets);
        const Truth truth = placed.intersects();
        EXPECT_TRUE(truth == Truth::too_close_to_call || meets == (truth == Truth::yes));
        EXPECT_EQ(run_alone(context(), placed.separation()).intersects, meets);
        return meets;
    }
    static bool check(const Rings& a, const Rings& b) {
        return check(Pair{{"A", a}, {"B", b}, {}, {}, 0.1});
    }
};

TEST_F(IntersectionTest, HoldsForRandomPairs) {
    int meet = 0;
    for_each_case(intersection_test_seed, 250, [&](Random& random) {
        Pair pair = any_pair(random);
        const double far = random.scale(0.1, 100.0) * pair.tolerance;
        const double direction = random.between(-3.2, 3.2);
        pair.pose_b.translation.x += far * std::cos(direction);
        pair.pose_b.translation.y += far * std::sin(direction);
        meet += check(std::move(pair)) ? 1 : 0;
    });
    EXPECT_GT(meet, random_cases(250) / 4);
    EXPECT_LT(meet, random_cases(250) * 19 / 20);
}

TEST_F(IntersectionTest, HoldsForEveryFamily) {
    for (const double apart : {0.0, 8.0, 15.0}) {
        for (Pair& pair : family_pairs(intersection_test_seed)) {
            pair.pose_b.translation.x += apart;
            check(std::move(pair));
        }
    }
}

TEST_F(IntersectionTest, TouchingAndContainmentCount) {
    const Rings square = rectangle({0, 0}, {4, 4});
    EXPECT_TRUE(check(square, rectangle({4, 1}, {5, 2})));  // along an edge
    EXPECT_TRUE(check(square, rectangle({4, 4}, {5, 5})));  // at a corner
    EXPECT_FALSE(check(square, rectangle({4.001, 1}, {5, 2})));
    EXPECT_TRUE(check(square, rectangle({1, 1}, {2, 2})));  // inside
    EXPECT_TRUE(check(square, square));
    const Rings frame{square[0], rectangle({1, 1}, {3, 3})[0]};
    EXPECT_FALSE(check(frame, rectangle({1.5, 1.5}, {2.5, 2.5})));  // in the hole
    EXPECT_TRUE(check(frame, rectangle({1.5, 1.5}, {2.5, 3})));     // touching its wall
    // No vertex of either is inside the other.
    EXPECT_TRUE(check(rectangle({0, 1}, {4, 2}), rectangle({1, 0}, {2, 4})));
    // One of several parts.
    EXPECT_TRUE(check(Rings{rectangle({9, 9}, {10, 10})[0], rectangle({1, 1}, {2, 2})[0]}, square));
}

/// The teeth of one comb in the gaps of the other: boxes of long chains overlap everywhere.
TEST_F(IntersectionTest, InterlockedCombsMeetOnlyIfTheyTouch) {
    constexpr int teeth = 200;
    constexpr double pitch = 2.0 / teeth;
    Ring narrow{{1.0, -1.0}, {-1.0, -1.0}};  // teeth narrower than the gaps
    for (int i = 0; i < teeth; ++i) {
        const double left = -1.0 + pitch * i;
        const double right = left + 0.4 * pitch;
        narrow.insert(narrow.end(),
                      {{left, 1.0}, {right, 1.0}, {right, -0.9}, {left + 0.99 * pitch, -0.9}});
    }
    for (const double turn : {0.0, 0.7}) {
        for (const bool touching : {false, true}) {
            const double x = (touching ? 0.7 : 0.89) * pitch;
            const double y = 0.5;
            // Rotated by 180 degrees about the origin, then moved along the row of teeth.
            const Pose turned{
                {std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y},
                turn + std::numbers::pi};
            EXPECT_EQ(check({{"A", {narrow}}, {"B", {narrow}}, {{}, turn}, turned, 0.1}), touching)
                << turn;
        }
    }
}

TEST_F(IntersectionTest, OutlinesTouchWhereTheyAreMovedToTheirSeparation) {
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        Pair pair{outlines[i], outlines[(i + 1) % outlines.size()], {}, {{5000.0, 80.0}, 0.4}, 0.5};
        const PlacedPair apart(context(), pair, Technique::cpu);
        ASSERT_FALSE(check(pair));
        const SeparationResult gap = run_alone(context(), apart.separation());
        for (const double part : {0.999, 1.001}) {
            Pair moved = pair;
            moved.pose_b.translation.x -= part * (gap.point_b.x - gap.point_a.x);
            moved.pose_b.translation.y -= part * (gap.point_b.y - gap.point_a.y);
            EXPECT_EQ(check(moved), part > 1.0) << outlines[i].name;
        }
    }
}

}  // namespace
}  // namespace nearfield::test
