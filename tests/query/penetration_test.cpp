#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

constexpr std::uint64_t penetration_seed = 4711;

class Penetration : public QueryTest {
protected:
    static void check(Pair pair) {
        const PlacedPair placed(context(), std::move(pair));
        const CorpusKeeper keeper(placed.pair(), placed.tolerance());
        SCOPED_TRACE(describe(placed.pair()));
        for (const PenetrationPoints points : both_ways) {
            check_penetration(placed, points, run_alone(context(), placed.penetration(points)));
        }
    }
    /// Checks two shapes in world coordinates.
    static void check(const Rings& a, const Rings& b, double tolerance) {
        check(Pair{{"A", a}, {"B", b}, {}, {}, tolerance});
    }
};

TEST_F(Penetration, HoldsForRandomPairs) {
    for_each_case(penetration_seed, 150, [&](Random& random) { check(any_pair(random)); });
}

TEST_F(Penetration, HoldsForEveryFamily) {
    for (const std::uint64_t round : {penetration_seed, penetration_seed + 6}) {
        SCOPED_TRACE("seed " + std::to_string(round));
        for (Pair& pair : family_pairs(round)) {
            check(std::move(pair));
        }
    }
}

/// Queries in both directions share whether the shapes meet, but not with the batch before: its
/// last query stood where the first of the other direction stands now.
TEST_F(Penetration, DoesNotOutliveItsBatch) {
    const std::vector<Ring> square{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
    const ShapeHandle a = *context().add_shape(square);
    const ShapeHandle b = *context().add_shape(square);
    PenetrationQuery there{{a, {}}, {b, {{0.5, 0.0}}}, 0.01};
    PenetrationQuery back{there.b, there.a, 0.01};
    there.technique = Technique::raster;
    back.technique = Technique::cpu;
    Batch batch;
    batch.add(there);
    const auto handle = batch.add(back);
    Results results;
    // Once before, so that a smaller batch leaves the queries of this one where they are.
    ASSERT_TRUE(context().run(batch, results).ok());
    PenetrationQuery apart{{a, {}}, {b, {{5.0, 0.0}}}, 0.01};
    apart.technique = Technique::cpu;
    EXPECT_EQ(run_alone(context(), apart).count, 0U);
    ASSERT_TRUE(context().run(batch, results).ok());
    EXPECT_TRUE(results[handle].intersects);
    EXPECT_GT(results[handle].count, 0U);
}

/// Along all four sides of a square within another one the depth is 1.
TEST_F(Penetration, OfEquallyDeepPointsTheFirstIsTheDeepest) {
    const ShapeHandle a = *context().add_shape(rectangle({0, 0}, {1, 1}));
    const ShapeHandle b = *context().add_shape(rectangle({-1, -1}, {2, 2}));
    for (const Technique technique : every_technique) {
        for (const PenetrationPoints points :
             {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            SCOPED_TRACE(to_string(technique));
            PenetrationQuery query{{a, {}}, {b, {}}, 0.0625};
            query.technique = technique;
            query.points = points;
            const PenetrationResult result = run_alone(context(), query);
            ASSERT_GT(result.count, 3U);
            const auto deepest =
                std::max_element(result.points.begin(), result.points.end(),
                                 [](const PenetratingPoint& one, const PenetratingPoint& other) {
                                     return one.depth < other.depth;
                                 });
            EXPECT_EQ(std::count_if(result.points.begin(), result.points.end(),
                                    [&](const PenetratingPoint& record) {
                                        return record.depth == deepest->depth;
                                    }),
                      result.count);
            EXPECT_EQ(result.deepest.position, deepest->position);
        }
    }
}

TEST_F(Penetration, HoldsForLongCoasts) {
    Random random(penetration_seed);
    for (const int n : {5000, 20000}) {
        SCOPED_TRACE(n);
        const Rings a = coast(random, n, 0.5);
        const Rings b = scaled_and_moved(coast(random, n / 2, 0.4), 1.5, {0.9, 0.4});
        check(a, b, 0.01);
        check(scaled_and_moved(a, 1.0, {1e6, -1e6}), scaled_and_moved(b, 1.0, {1e6, -1e6}), 0.01);
    }
}

TEST_F(Penetration, HoldsForIdenticalCopiesAndSharedEdges) {
    Random random(penetration_seed);
    const Rings shape = star(random, 60, 0.5);
    check(shape, shape, 0.02);
    const Rings left = rectangle({-2, -1}, {0, 1});
    check(left, rectangle({0, -1}, {2, 1}), 0.05);
    check(left, rectangle({0, -0.3}, {2, 3}), 0.05);
    check(left, rectangle({-1, -1}, {2, 1}), 0.05);  // overlapping, edges on one line
    check(left, rectangle({-1.5, -0.5}, {-0.5, 0.5}), 0.05);
    check(rectangle({-1.5, -0.5}, {-0.5, 0.5}), left, 0.05);
}

TEST_F(Penetration, HoldsForShapesSmallerThanACell) {
    Random random(penetration_seed);
    const Rings big = star(random, 30, 0.6);
    check(scaled_and_moved(star(random, 9, 0.5), 1e-3, {0.1, 0.05}), big, 0.1);
    check(big, scaled_and_moved(star(random, 9, 0.5), 1e-3, {0.1, 0.05}), 0.1);
    check(big, big, 10.0);
}

TEST_F(Penetration, HoldsAtExtremeScales) {
    Random random(penetration_seed);
    const Rings a = with_holes(random, 6);
    const Rings b = scaled_and_moved(coast(random, 400, 0.5), 1.2, {0.6, -0.3});
    for (const double factor : {1e-12, 1e-6, 1e6, 1e11}) {
        SCOPED_TRACE(factor);
        check(scaled_and_moved(a, factor, {}), scaled_and_moved(b, factor, {}), 0.02 * factor);
    }
}

TEST_F(Penetration, HoldsForAThousandParts) {
    Random random(penetration_seed);
    Rings parts;
    for (int i = 0; i < 1000; ++i) {
        const Vector2 place{0.06 * (i % 40) - 1.2, 0.1 * (i / 40) - 1.2};
        parts.push_back(scaled_and_moved(star(random, 6, 0.5), 0.028, place)[0]);
    }
    check(parts, star(random, 30, 0.5), 0.01);
    check(star(random, 30, 0.5), parts, 0.01);
}

TEST_F(Penetration, DepthOfARectangleIsPlain) {
    // The left side of A is 3 deep in B, nearest to B's right side; no other side is as near.
    const PlacedPair pair(
        context(),
        {{"A", rectangle({7, 4}, {30, 6})}, {"B", rectangle({0, 0}, {10, 10})}, {}, {}, 0.1});
    const PenetrationResult result = run_alone(context(), pair.penetration());
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_TRUE(result.intersects);
    EXPECT_NEAR(result.deepest.depth, 3.0, result.error_bound);
    EXPECT_EQ(result.deepest.feature.kind, Feature::Kind::edge);
    EXPECT_EQ(result.deepest.feature.index, 1U);
    EXPECT_NEAR(result.deepest.direction.x, 1.0, 1e-9);
    for (const PenetratingPoint& record : result.points) {
        EXPECT_TRUE(record.unique) << record.position.x << ", " << record.position.y;
        EXPECT_NEAR(record.depth, 10.0 - record.position.x, 1e-6);
    }
}

TEST_F(Penetration, DirectionsOnTheMedialAxisAreNotUnique) {
    // A's upper side runs along the middle line of the bar B: up and down are equally far.
    const PlacedPair pair(
        context(),
        {{"A", rectangle({-3, -5}, {3, 0})}, {"B", rectangle({-20, -1}, {20, 1})}, {}, {}, 0.1});
    const PenetrationResult result = run_alone(context(), pair.penetration());
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    int on_axis = 0;
    for (const PenetratingPoint& record : result.points) {
        const bool middle = std::abs(record.position.y) < 1e-6;
        on_axis += middle ? 1 : 0;
        if (middle || std::abs(record.position.y) > 1e-3) {
            EXPECT_EQ(record.unique, !middle) << record.position.x << ", " << record.position.y;
        }
    }
    EXPECT_GT(on_axis, 10);
}

TEST_F(Penetration, SummaryIsTheSameWithoutRecords) {
    for (Pair& pair : family_pairs(penetration_seed + 2)) {
        const PlacedPair placed(context(), std::move(pair));
        SCOPED_TRACE(describe(placed.pair()));
        for (const PenetrationPoints points : both_ways) {
            PenetrationQuery query = placed.penetration(points);
            const PenetrationResult with = run_alone(context(), query);
            query.summary_only = true;
            const PenetrationResult without = run_alone(context(), query);
            ASSERT_TRUE(without.status.ok()) << without.status.text();
            EXPECT_TRUE(without.points.empty());
            EXPECT_EQ(with.count, without.count);
            EXPECT_EQ(with.intersects, without.intersects);
            if (with.count > 0) {
                EXPECT_EQ(with.deepest.depth, without.deepest.depth);
                EXPECT_EQ(with.deepest.position, without.deepest.position);
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::test
