#include <tests/query/device_offers.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace nearfield::test {
namespace {

struct RoundShape {
    Vector2 centre;
    double radius = 0.0;
};

double distance(const Vector2& a, const Vector2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// The signed distance to a circle, negative inside.
double signed_distance(const RoundShape& circle, const Vector2& point) {
    return distance(circle.centre, point) - circle.radius;
}

/// The depth of the deepest point of the boundary of `a` in `b`; negative if none is inside.
double deepest(const RoundShape& a, const RoundShape& b) {
    return b.radius - std::abs(distance(a.centre, b.centre) - a.radius);
}

/// Two circles as curves, tessellated with known deviations.
class Curves : public QueryTest {
protected:
    Instance add(const RoundShape& circle, double deviation) {
        const auto rings = tessellate(CurvePath().circle(circle.centre, circle.radius), deviation);
        EXPECT_TRUE(rings.has_value()) << rings.error().text();
        auto shape = context().add_shape(*rings, deviation);
        EXPECT_TRUE(shape.has_value()) << shape.error().text();
        added_.push_back(*shape);
        return {*shape, {}};
    }

    void TearDown() override {
        for (const ShapeHandle shape : added_) {
            EXPECT_TRUE(context().remove_shape(shape).ok());
        }
        QueryTest::TearDown();
    }

    std::vector<ShapeHandle> added_;
};

TEST_F(Curves, PenetrationOfCirclesIsWithinItsBoundOfTheAnalyticAnswer) {
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(random_cases(6)); ++seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> part(0.0, 1.0);
        const RoundShape a{{part(random), part(random)}, 1.0 + 2.0 * part(random)};
        const RoundShape b{{2.0 + part(random), 1.0 + part(random)}, 2.0 + part(random)};
        for (const double share : {0.02, 0.12}) {
            const double d = 0.15;
            PenetrationQuery query;
            query.technique = Technique::raster;
            query.a = add(a, share * d);
            query.b = add(b, share * d);
            query.tolerance = d;
            const PenetrationResult result = run_alone(context(), query);
            ASSERT_TRUE(result.status.ok()) << result.status.text();
            EXPECT_LE(result.error_bound, d);
            EXPECT_GE(result.error_bound, 2.0 * share * d);
            ASSERT_GT(result.count, 0U) << "seed " << seed;
            EXPECT_NEAR(result.deepest.depth, deepest(a, b), result.error_bound)
                << "seed " << seed << ", share " << share;
            for (const PenetratingPoint& record : result.points) {
                EXPECT_LE(std::abs(signed_distance(a, record.position)), share * d + 1e-12);
                EXPECT_NEAR(record.depth, -signed_distance(b, record.position), share * d + 1e-12);
            }
        }
    }
}

void check_field_of(const RoundShape& circle, const DistanceFieldResult& result) {
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_LE(result.error_bound, result.tolerance);
    ASSERT_FALSE(result.values.empty());
    for (std::uint32_t row = 0; row < result.height; ++row) {
        for (std::uint32_t column = 0; column < result.width; ++column) {
            const Vector2 point{result.origin.x + (column + 0.5) * result.cell,
                                result.origin.y + (row + 0.5) * result.cell};
            ASSERT_NEAR(static_cast<double>(result.values[row * result.width + column]),
                        signed_distance(circle, point), result.error_bound);
        }
    }
}

TEST_F(Curves, FieldOfACircleIsWithinItsBoundOfTheAnalyticAnswer) {
    const RoundShape circle{{0.3, -0.2}, 2.0};
    // With the minimum number of sub-pixel bits, a raster needs three quarters of the tolerance
    // plus a margin for rounding, which leaves less than a quarter for the rings (error budget).
    const bool coarse = sub_pixel_bits(host_device()) == 4;
    for (const Technique technique : every_technique) {
        for (const double share : {0.05, 0.248, max_deviation}) {
            SCOPED_TRACE(std::string(to_string(technique)) + " " + std::to_string(share));
            DistanceFieldQuery query;
            query.b = add(circle, share * 0.2);
            query.tolerance = 0.2;
            query.rectangle = Rectangle{{-4, -4}, {4, 4}};
            query.technique = technique;
            const DistanceFieldResult result = run_alone(context(), query);
            if (coarse && share == max_deviation && technique != Technique::cpu) {
                EXPECT_EQ(result.status.code(), StatusCode::invalid_query);
                EXPECT_NE(result.status.message().find("this device's raster"), std::string::npos)
                    << result.status.text();
            } else {
                check_field_of(circle, result);
            }
        }
    }
}

/// Every sample is near the shape it belongs to, and every true point is near a sample.
TEST_F(Curves, IntersectionsOfCirclesKeepTheirLaw) {
    const RoundShape a{{0, 0}, 2.0};
    const RoundShape b{{2.6, 0.5}, 1.5};
    const double d = 0.2;
    IntersectionQuery query;
    query.technique = Technique::raster;
    query.a = add(a, 0.15 * d);
    query.b = add(b, 0.1 * d);
    query.tolerance = d;
    for (const auto kind : {IntersectionKind::volume_volume, IntersectionKind::boundary_volume,
                            IntersectionKind::boundary_boundary}) {
        query.kind = kind;
        const IntersectionResult result = run_alone(context(), query);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        const double bound = result.error_bound;
        EXPECT_LE(bound, d);
        const auto off = [](double signed_value, bool boundary) {
            return boundary ? std::abs(signed_value) : std::max(signed_value, 0.0);
        };
        const bool boundary_a = kind != IntersectionKind::volume_volume;
        const bool boundary_b = kind == IntersectionKind::boundary_boundary;
        for (const IntersectionSample& sample : result.samples) {
            EXPECT_LE(off(signed_distance(a, sample.position), boundary_a), bound);
            EXPECT_LE(off(signed_distance(b, sample.position), boundary_b), bound);
        }
        const auto expect_sample_near = [&](const Vector2& point) {
            EXPECT_TRUE(std::any_of(
                result.samples.begin(), result.samples.end(),
                [&](const auto& sample) { return distance(sample.position, point) <= bound; }))
                << point.x << ", " << point.y;
        };
        int points = 0;
        for (int i = 0; i < 40; ++i) {
            for (int j = 0; j < 100; ++j) {
                const double radius = boundary_a ? a.radius : a.radius * (i + 0.5) / 40.0;
                const double angle = 0.0628318 * j;
                const Vector2 point{radius * std::cos(angle), radius * std::sin(angle)};
                const bool in_a = boundary_a || signed_distance(a, point) < -bound;
                if (!boundary_b && in_a && signed_distance(b, point) < -bound) {
                    expect_sample_near(point);
                    ++points;
                }
            }
        }
        if (boundary_b) {
            // The crossings of both circles, by Heron's formula.
            const double between = distance(a.centre, b.centre);
            const double along =
                (a.radius * a.radius - b.radius * b.radius + between * between) / (2.0 * between);
            const double across = std::sqrt(a.radius * a.radius - along * along);
            const Vector2 unit{b.centre.x / between, b.centre.y / between};
            expect_sample_near(
                {along * unit.x - across * unit.y, along * unit.y + across * unit.x});
            expect_sample_near(
                {along * unit.x + across * unit.y, along * unit.y - across * unit.x});
            points = 2;
        }
        EXPECT_GT(points, 1);
    }
}

TEST_F(Curves, TooMuchDeviationIsRefusedByName) {
    PenetrationQuery query;
    query.technique = Technique::raster;
    query.a = add({{0, 0}, 2}, 0.03);
    query.b = add({{1, 0}, 2}, 0.03);
    query.tolerance = 0.2;
    const PenetrationResult result = run_alone(context(), query);
    EXPECT_EQ(result.status.code(), StatusCode::invalid_query);
    EXPECT_NE(result.status.message().find("off by 0.03 (A) and 0.03 (B)"), std::string::npos)
        << result.status.message();
    // A distance field depends on A only through its box.
    DistanceFieldQuery field{query.a, query.b, 0.2, std::nullopt};
    field.technique = Technique::raster;
    EXPECT_TRUE(run_alone(context(), field).status.ok());
    // An update replaces the deviation of the rings.
    const std::vector<Ring> rings{{{0, 0}, {2, 0}, {2, 2}}};
    ASSERT_TRUE(context().update_shape(query.a.shape, rings).ok());
    EXPECT_TRUE(run_alone(context(), query).status.ok());
    for (const double bad : {-1.0, std::nan(""), 1e300}) {
        EXPECT_EQ(context().update_shape(query.a.shape, rings, bad).code(),
                  StatusCode::invalid_shape);
        EXPECT_EQ(context().add_shape(rings, bad).error().code(), StatusCode::invalid_shape);
    }
}

}  // namespace
}  // namespace nearfield::test
