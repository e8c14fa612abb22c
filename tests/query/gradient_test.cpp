#include <tests/oracle/plane.hpp>
#include <tests/query/device_offers.hpp>
#include <tests/query/field_laws.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::test {
namespace {

constexpr std::uint64_t gradient_seed = 31337;

class Gradients : public FieldLaws {
protected:
    /// Differences of a field by the raster.
    static DistanceFieldQuery differences_of(const PlacedShape& shape) {
        DistanceFieldQuery query;
        query.technique = Technique::raster;
        query.b = shape.instance();
        query.tolerance = 0.01;
        query.rectangle = {{-1.5, -1.5}, {1.5, 1.5}};
        query.gradients = true;
        query.gradient = GradientMethod::central_differences;
        return query;
    }
    /// Blending costs no more than the precision of a format.
    static void check_format(Context& context, DistanceFieldQuery query, const char* format) {
        const auto differences = run_alone(context, query);
        query.gradient = GradientMethod::blended;
        const auto blended = run_alone(context, query);
        ASSERT_TRUE(blended.status.ok()) << blended.status.text();
        EXPECT_STREQ(blended.gradient_format, format);
        check_blended(differences, blended);
    }
};

/// The device blends single precision; otherwise half precision must suffice.
TEST_F(Gradients, HalfPrecisionIsWithinWhatItStates) {
    test_support::Lies lies;
    lies.format = [](VkFormat format, VkFormatProperties& properties) {
        if (format == VK_FORMAT_R32G32_SFLOAT) {
            properties.optimalTilingFeatures &=
                ~static_cast<VkFormatFeatureFlags>(VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
        }
    };
    const test_support::FakeLoader loader(host_device(), std::move(lies));
    Expected<Context> half = Context::create(loader.host(), on_demand());
    ASSERT_TRUE(half.has_value()) << half.error().text();
    Random random(gradient_seed);
    const PlacedShape shape(*half, star(random, 30, 0.4), {});
    DistanceFieldQuery query = differences_of(shape);
    check_differences(shape.oracle(), run_alone(*half, query));
    check_format(*half, query, "R16G16_SFLOAT");
    // If half precision carries no information, the result says so.
    query.rectangle = {{-1.5, 30.0}, {1.5, 31.0}};
    EXPECT_TRUE(run_alone(*half, query).status.ok());
    query.gradient = GradientMethod::blended;
    EXPECT_EQ(run_alone(*half, query).status.code(), StatusCode::invalid_query);
}

TEST_F(Gradients, SinglePrecisionCostsNearlyNothing) {
    Random random(gradient_seed);
    const PlacedShape shape(context(), star(random, 30, 0.4), {});
    const bool single = offers(host_device(), "blending of VK_FORMAT_R32G32_SFLOAT");
    check_format(context(), differences_of(shape), single ? "R32G32_SFLOAT" : "R16G16_SFLOAT");
}

/// A gradient on the boundary itself is the outward normal.
TEST_F(Gradients, OnTheBoundaryAreTheWall) {
    const PlacedShape shape(context(), rectangle({0, 0}, {4, 4}), {});
    DistanceFieldQuery query;
    query.technique = Technique::raster;
    query.b = shape.instance();
    query.tolerance = 0.1;
    query.rectangle = {{-1, -1}, {5, 5}};
    const std::vector<Vector2> points{{2, 0}, {4, 1}, {3, 4}, {0, 3}};
    query.points = points;
    const auto result = run_alone(context(), query);
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    const std::vector<Vector2> expected{{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(result.points[i].gradient, expected[i]) << i;
        EXPECT_TRUE(result.points[i].unique) << i;
    }
}

/// Rotating and moving everything rotates the gradient and changes nothing else.
TEST_F(Gradients, FollowRigidMotions) {
    const int cases = random_cases(30);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(gradient_seed) + " case " + std::to_string(i));
        Random random(gradient_seed + 2000 + static_cast<std::uint64_t>(i));
        const Rings rings = any_shape(random).rings;
        const Pose motion{{random.between(-50.0, 50.0), random.between(-50.0, 50.0)},
                          random.between(-3.0, 3.0)};
        const PlacedShape here(context(), rings, {});
        const PlacedShape there(context(), rings, motion);
        std::vector<Vector2> points;
        std::vector<Vector2> moved;
        for (int k = 0; k < 50; ++k) {
            points.push_back({random.between(-1.2, 1.2), random.between(-1.2, 1.2)});
            moved.push_back(oracle::plus(turned(points.back(), motion.angle), motion.translation));
        }
        DistanceFieldQuery query;
        query.technique = Technique::raster;
        query.tolerance = 0.05;
        query.values = false;
        query.b = here.instance();
        query.points = points;
        query.rectangle = box_around(points);
        const auto before = run_alone(context(), query);
        query.b = there.instance();
        query.points = moved;
        query.rectangle = box_around(moved);
        const auto after = run_alone(context(), query);
        ASSERT_TRUE(before.status.ok()) << before.status.text();
        ASSERT_TRUE(after.status.ok()) << after.status.text();
        Report report("moved points");
        for (std::size_t k = 0; k < points.size(); ++k) {
            const FieldPoint& p = before.points[k];
            const FieldPoint& q = after.points[k];
            report.require(std::abs(p.distance - q.distance) <= p.error_bound + q.error_bound,
                           "distance ", p.distance, " becomes ", q.distance);
            const double truth = here.oracle().nearest(points[k]).distance;
            if (p.unique && q.unique && truth > 1e-3) {
                // Any of the features within d/1000 of each other on one wall may be reported, and
                // coincident vertices have several indices.
                const double margin = query.tolerance / 1000;
                const double along_wall = std::sqrt(margin * (2 * truth + margin));
                const Vector2 expected = turned(p.gradient, motion.angle);
                report.require(
                    oracle::distance(expected, q.gradient) <= 1e-7 + 2.05 * along_wall / truth,
                    "gradient at ", k, " is off by ", oracle::distance(expected, q.gradient));
                report.require(
                    std::abs(distance_to_feature(here.oracle(), p.feature, points[k]) -
                             distance_to_feature(there.oracle(), q.feature, moved[k])) <= margin,
                    "feature at ", k);
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::test
