#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>

#include <cmath>

namespace nearfield::test {
namespace {

constexpr std::uint64_t closest_seed = 2718;

class Closest : public QueryTest {
protected:
    static SeparationResult check(Pair pair) {
        const PlacedPair placed(context(), std::move(pair));
        const CorpusKeeper keeper(placed.pair(), placed.tolerance());
        SCOPED_TRACE(describe(placed.pair()));
        const SeparationResult separation = run_alone(context(), placed.separation());
        check_separation(placed, separation);
        check_same(separation, run_alone(context(), placed.closest_point()));
        return separation;
    }
    static SeparationResult check(const Rings& a, const Rings& b, double tolerance) {
        return check(Pair{{"A", a}, {"B", b}, {}, {}, tolerance});
    }
};

TEST_F(Closest, ParallelEdgesAreNotUnique) {
    const Rings left = rectangle({-2, -1}, {0, 1});
    const SeparationResult result = check(left, rectangle({0.5, -0.4}, {2, 5}), 0.1);
    EXPECT_EQ(result.distance, 0.5);
    EXPECT_FALSE(result.unique);
    EXPECT_TRUE(check(left, {{{0.5, 0}, {2, -1}, {2, 1}}}, 0.1).unique);
}

TEST_F(Closest, TinyTolerancesCostNoMoreSamples) {
    const Rings left = rectangle({0, 0}, {1e5, 1e5});
    const SeparationResult result = check(left, rectangle({2e5, 0}, {3e5, 1e5}), 1e-4);
    EXPECT_EQ(result.distance, 1e5);
    EXPECT_GT(result.cell, 1.0);
}

TEST_F(Closest, ATipBetweenTwoProngsIsNotUniqueEitherWay) {
    const Rings tip{{{0, 0}, {-1, -3}, {1, -3}}};
    const Rings fork{{{-2, 2}, {2, 2}, {2, 4}, {1, 3}, {-1, 3}, {-2, 4}}};
    const Rings prongs{{{-1, 1}, {0, 3}, {1, 1}, {2, 4}, {-2, 4}}};
    EXPECT_FALSE(check(tip, prongs, 0.05).unique);
    EXPECT_FALSE(check(prongs, tip, 0.05).unique);
    EXPECT_TRUE(check(tip, fork, 0.05).unique);
}

TEST_F(Closest, TiesAreNotUnique) {
    const Rings fork{{{0, 0}, {4, 0}, {4, 2}, {3, 1}, {1, 1}, {0, 2}}};
    EXPECT_FALSE(check(fork, rectangle({-1, 3}, {5, 4}), 0.05).unique);
}

TEST_F(Closest, ContainmentIsDistanceZero) {
    const Rings outer = rectangle({-5, -5}, {5, 5});
    const Rings inner = rectangle({-1, -1}, {1, 1});
    EXPECT_TRUE(check(outer, inner, 0.1).intersects);
    EXPECT_TRUE(check(inner, outer, 0.1).intersects);
    // Inside a hole there is a positive distance.
    const Rings frame{outer[0], rectangle({-3, -3}, {3, 3})[0]};
    EXPECT_EQ(check(frame, inner, 0.1).distance, 2.0);
    // One of several parts is inside.
    const Rings parts{rectangle({10, 0}, {11, 1})[0], inner[0]};
    EXPECT_EQ(check(parts, outer, 0.1).distance, 0.0);
}

TEST_F(Closest, OverlappingBoxesAndTouch) {
    const Rings corner{{{0, 0}, {10, 0}, {10, 1}, {1, 1}, {1, 10}, {0, 10}}};
    EXPECT_EQ(check(corner, rectangle({3, 4}, {9, 9}), 0.1).distance, 2.0);
    EXPECT_EQ(check(corner, rectangle({1, 1}, {9, 9}), 0.1).distance, 0.0);
}

TEST_F(Closest, FarApartAtASmallTolerance) {
    Random random(closest_seed);
    const Rings a = star(random, 40, 0.6);
    const Rings b = star(random, 50, 0.6);
    for (const double far : {1e2, 1e4, 1e6}) {
        check(a, scaled_and_moved(b, 1.0, {far, far / 3}), 0.01);
    }
    check(scaled_and_moved(a, 1.0, {1e6, 0}), scaled_and_moved(b, 1.0, {1e6 + 7, 1}), 0.01);
}

TEST_F(Closest, ATolerancePastTheShapesLeavesNothingToBeAmbiguous) {
    Random random(closest_seed);
    const Rings a = star(random, 600, 0.9);
    const Rings b = scaled_and_moved(star(random, 700, 0.9), 1.0, {3.0, 0.2});
    for (const double tolerance : {1.0, 100.0, 1e6}) {
        check(a, b, tolerance);
    }
}

TEST_F(Closest, OutlinesAreExact) {
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const NamedRings& other = outlines[(i + 1) % outlines.size()];
        for (const double apart : {430.0, 700.0}) {
            const double angle = static_cast<double>(i);
            check(Pair{outlines[i],
                       other,
                       {},
                       {{apart * std::cos(angle), apart * std::sin(angle)}, 0.4},
                       0.5});
        }
    }
}

}  // namespace
}  // namespace nearfield::test
