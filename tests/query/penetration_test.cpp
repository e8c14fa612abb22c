#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

class Penetration : public QueryTest {};

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

}  // namespace
}  // namespace nearfield::test
