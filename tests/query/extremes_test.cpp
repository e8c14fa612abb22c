#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>
#include <numbers>

// Cases at the limits of single precision on the device and of double precision in the world.

namespace nearfield::test {
namespace {

class Extremes : public QueryTest {};

Rings polygon_around(const Vector2& centre, double radius, int n, double turn) {
    Ring ring;
    for (int i = 0; i < n; ++i) {
        const double angle = turn + 2.0 * std::numbers::pi * i / n;
        ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return {ring};
}

TEST_F(Extremes, DeepInsideAHugeShapeRecordsAreStillExact) {
    for (const double radius : {1e3, 1e5, 1e7}) {
        SCOPED_TRACE(radius);
        const PlacedPair placed(context(), Pair{{"A", polygon_around({0.4, -0.3}, 3.0, 7, 0.1)},
                                                {"B", polygon_around({0.0, 0.0}, radius, 97, 0.05)},
                                                {},
                                                {},
                                                0.1});
        for (const auto points : {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            check_penetration(placed, points, run_alone(context(), placed.penetration(points)));
        }
    }
}

/// A strip so long that its long edges have very many samples, through a small square.
class LongStrip : public Extremes {
protected:
    static void expect_samples(double low, double deepest, double tolerance) {
        const auto a = context().add_shape(rectangle({-1e6, low}, {1e6, 0.001}));
        const auto b = context().add_shape(rectangle({-0.05, -0.05}, {0.05, 0.05}));
        ASSERT_TRUE(a.has_value() && b.has_value());
        PenetrationQuery query;
        query.a.shape = *a;
        query.b.shape = *b;
        query.tolerance = tolerance;
        // A length of 0.1 for each long edge inside, with samples at most d times the square root
        // of two apart.
        const double of_an_edge = 0.1 / (tolerance * std::numbers::sqrt2);
        const double edges_inside = low > -0.05 ? 2.0 : 1.0;
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            query.technique = technique;
            const PenetrationResult result = run_alone(context(), query);
            ASSERT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_NEAR(result.count, edges_inside * of_an_edge, 4.0);
            EXPECT_NEAR(result.deepest.depth, deepest, tolerance);
            const ContactResult contacts =
                run_alone(context(), ContactQuery{query.a, query.b, tolerance, tolerance,
                                                  ContactNormals::analytic, false, technique});
            ASSERT_TRUE(contacts.status.ok()) << contacts.status.text();
            EXPECT_GT(contacts.count, 4U);
        }
        EXPECT_TRUE(context().remove_shape(*a).ok());
        EXPECT_TRUE(context().remove_shape(*b).ok());
    }
};

TEST_F(LongStrip, IsSampledWhereItMatters) {
    // 14,000,000,000 samples per edge, more than 32 bits can count, and 700,000,000.
    expect_samples(-0.001, 0.049, 1e-4);
    expect_samples(-0.001, 0.049, 2e-3);
}

TEST_F(LongStrip, IsSampledWhereItMattersAlongAnEdge) {
    // The lower edge of the strip is on that of the square.
    expect_samples(-0.05, 0.049, 1e-4);
    expect_samples(-0.05, 0.049, 2e-3);
}

TEST_F(Extremes, AFieldFarAwayStatesWhatSinglePrecisionLeavesOrIsRefused) {
    const auto b = context().add_shape(rectangle({0.0, 0.0}, {1.0, 2.0}));
    ASSERT_TRUE(b.has_value());
    for (const double x : {1e3, 1e5, 1e6, 1e7}) {
        SCOPED_TRACE(x);
        DistanceFieldQuery query;
        query.technique = Technique::raster;
        query.b.shape = *b;
        query.tolerance = 0.1;
        query.rectangle = Rectangle{{x, 0.0}, {x + 5.0, 2.0}};
        const DistanceFieldResult result = run_alone(context(), query);
        if (!result.status.ok()) {
            EXPECT_EQ(result.status.code(), StatusCode::invalid_query) << result.status.text();
            EXPECT_GT(x, 1e4);
            continue;
        }
        EXPECT_LE(result.error_bound, 0.1);
        EXPECT_LT(x, 1e7);
        for (std::uint32_t column = 0; column < result.width; ++column) {
            // The lowest row of cell centres is between the box's lower and upper side.
            const double centre = result.origin.x + (column + 0.5) * result.cell;
            EXPECT_NEAR(static_cast<double>(result.values[column]), centre - 1.0,
                        result.error_bound);
        }
    }
    EXPECT_TRUE(context().remove_shape(*b).ok());
}

TEST_F(Extremes, TolerancesThatCoordinatesCannotResolveAreRefused) {
    // Its own coordinates are huge; in the world it is near the origin.
    const auto far = context().add_shape(rectangle({5e11, 5e11}, {5e11 + 1.0, 5e11 + 1.0}));
    const auto near = context().add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    ASSERT_TRUE(far.has_value() && near.has_value());
    PenetrationQuery query;
    query.technique = Technique::raster;
    query.a.shape = *far;
    query.a.pose.translation = {-5e11, -5e11};
    query.b.shape = *near;
    query.tolerance = 1e-6;
    EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::invalid_query);
    for (const double tolerance : {1e13, 1e300, 1.7e308}) {
        query.tolerance = tolerance;
        EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::invalid_query);
    }
    EXPECT_TRUE(context().remove_shape(*far).ok());
    EXPECT_TRUE(context().remove_shape(*near).ok());
}

TEST_F(Extremes, ALongEdgeOfAIsSampledOnlyNearB) {
    const PlacedPair placed(context(), Pair{{"A", rectangle({-5000.0, -1.0}, {5000.0, 0.0})},
                                            {"B", polygon_around({10.3, 0.1}, 0.5, 12, 0.0)},
                                            {},
                                            {},
                                            1e-3});
    const auto result = run_alone(context(), placed.penetration(PenetrationPoints::boundary));
    check_penetration(placed, PenetrationPoints::boundary, result);
    EXPECT_GT(result.count, 300U);
}

TEST_F(Extremes, ManyOverlapTilesFillABufferToItsEnd) {
    // Only tiles in the input buffer, of about the size to which it grows.
    for (const int count : {1360, 1365, 4092, 4096}) {
        auto fresh = Context::create(host_device(), on_demand());
        ASSERT_TRUE(fresh.has_value());
        const auto square = fresh->add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        ASSERT_TRUE(square.has_value());
        IntersectionQuery query;
        query.technique = Technique::raster;
        query.a.shape = query.b.shape = *square;
        query.b.pose.translation = {0.5, 0.5};
        query.tolerance = 0.3;
        Batch batch;
        Results results;
        for (int i = 0; i < count; ++i) {
            batch.add(query);
        }
        ASSERT_TRUE(fresh->run(batch, results).ok());
        for (const AnyResult& result : results.results) {
            ASSERT_GT(std::get<IntersectionResult>(result).count, 0U);
        }
    }
}

}  // namespace
}  // namespace nearfield::test
