#include <tests/oracle/plane.hpp>
#include <tests/query/device_offers.hpp>
#include <tests/query/field_laws.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace nearfield::test {
namespace {

constexpr std::uint64_t gradient_seed = 31337;

class Gradients : public FieldLaws {
protected:
    /// Records the cost of blending in the test's report.
    static void record_cost(const DistanceFieldResult& differences,
                            const DistanceFieldResult& blended) {
        double sum = 0.0;
        for (std::size_t i = 0; i < differences.gradients.size(); ++i) {
            sum += std::abs(static_cast<double>(differences.gradients[i] - blended.gradients[i]));
        }
        float farthest = 0.0F;
        for (const float value : differences.values) {
            farthest = std::max(farthest, std::abs(value));
        }
        const auto text = [](double number) {
            std::ostringstream stream;
            stream << number;
            return stream.str();
        };
        RecordProperty("largest", text(max_apart(differences, blended)));
        RecordProperty("mean", text(sum / static_cast<double>(differences.gradients.size())));
        RecordProperty("stated",
                       text(blended.gradient_error_bound - differences.gradient_error_bound));
        RecordProperty("farthest_cells", text(static_cast<double>(farthest) / differences.cell));
    }
};

TEST_F(Gradients, FeaturesAndAnalyticGradientsHoldForRandomShapes) {
    const int cases = random_cases(60);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(gradient_seed) + " case " + std::to_string(i));
        Random random(gradient_seed + static_cast<std::uint64_t>(i));
        const AnyField field(context(), random);
        DistanceFieldQuery query = field.query();
        query.features = query.gradients = true;
        query.sign = static_cast<SignEncoding>(i % 3);
        SCOPED_TRACE(field.text());
        check_cells(field.oracle(), query, run_alone(context(), query));
        query.technique = Technique::cpu;
        check_cells(field.oracle(), query, run_alone(context(), query), 1000);
    }
}

TEST_F(Gradients, FeaturesAndAnalyticGradientsHoldForEveryFamily) {
    for (const auto& [name, rings] : every_family(gradient_seed)) {
        SCOPED_TRACE(name);
        const PlacedShape shape(context(), rings, {{0.5, -0.25}, 0.9});
        DistanceFieldQuery query;
        query.b = shape.instance();
        query.tolerance = 0.03;
        query.rectangle = {{-1.0, -1.5}, {2.0, 1.0}};
        query.features = query.gradients = true;
        check_cells(shape.oracle(), query, run_alone(context(), query));
        query.technique = Technique::cpu;
        check_cells(shape.oracle(), query, run_alone(context(), query), 1000);
    }
}

TEST_F(Gradients, CentralDifferencesHoldAndBlendingAgrees) {
    const int cases = random_cases(40);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(gradient_seed) + " case " + std::to_string(i));
        Random random(gradient_seed + 1000 + static_cast<std::uint64_t>(i));
        const AnyField field(context(), random);
        SCOPED_TRACE(field.text());
        DistanceFieldQuery query = field.query();
        query.gradients = true;
        query.gradient = GradientMethod::central_differences;
        const auto differences = run_alone(context(), query);
        query.gradient = GradientMethod::blended;
        const auto blended = run_alone(context(), query);
        check_differences(field.oracle(), differences);
        check_blended(differences, blended);
        // Two errors over two cells.
        EXPECT_DOUBLE_EQ(differences.gradient_error_bound,
                         differences.error_bound / differences.cell);
        query.technique = Technique::cpu;
        EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::invalid_query);
        query.gradient = GradientMethod::central_differences;
        check_differences(field.oracle(), run_alone(context(), query), 1000);
    }
}

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
    const Rings rings = star(random, 30, 0.4);
    const PlacedShape shape(*half, rings, {});
    DistanceFieldQuery query;
    query.technique = Technique::raster;
    query.b = shape.instance();
    query.tolerance = 0.01;
    query.rectangle = {{-1.5, -1.5}, {1.5, 1.5}};
    query.gradients = true;
    query.gradient = GradientMethod::central_differences;
    const auto differences = run_alone(*half, query);
    query.gradient = GradientMethod::blended;
    const auto blended = run_alone(*half, query);
    ASSERT_TRUE(blended.status.ok()) << blended.status.text();
    EXPECT_STREQ(blended.gradient_format, "R16G16_SFLOAT");
    check_differences(shape.oracle(), differences);
    check_blended(differences, blended);
    record_cost(differences, blended);

    // If half precision carries no information, the result says so.
    query.rectangle = {{-1.5, 30.0}, {1.5, 31.0}};
    EXPECT_EQ(run_alone(*half, query).status.code(), StatusCode::invalid_query);
    query.gradient = GradientMethod::central_differences;
    EXPECT_TRUE(run_alone(*half, query).status.ok());
}

TEST_F(Gradients, SinglePrecisionCostsNearlyNothing) {
    Random random(gradient_seed);
    const PlacedShape shape(context(), star(random, 30, 0.4), {});
    DistanceFieldQuery query;
    query.technique = Technique::raster;
    query.b = shape.instance();
    query.tolerance = 0.01;
    query.rectangle = {{-1.5, -1.5}, {1.5, 1.5}};
    query.gradients = true;
    query.gradient = GradientMethod::central_differences;
    const auto differences = run_alone(context(), query);
    query.gradient = GradientMethod::blended;
    const auto blended = run_alone(context(), query);
    ASSERT_TRUE(blended.status.ok()) << blended.status.text();
    const bool single = offers(host_device(), "blending of VK_FORMAT_R32G32_SFLOAT");
    EXPECT_STREQ(blended.gradient_format, single ? "R32G32_SFLOAT" : "R16G16_SFLOAT");
    check_blended(differences, blended);
    record_cost(differences, blended);
}

/// Several tiles and tile batches: no seams.
TEST_F(Gradients, HoldAcrossTilesAndRounds) {
    Random random(gradient_seed + 7);
    Settings settings;
    settings.memory_limit = std::uint64_t{24} << 20U;  // a small atlas
    Expected<Context> small = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    const PlacedShape shape(*small, scaled_and_moved(star(random, 12, 0.3), 20.0, {}), {});
    DistanceFieldQuery query;
    query.technique = Technique::raster;
    query.b = shape.instance();
    query.tolerance = 0.02;
    query.rectangle = {{-20.0, 3.0}, {20.0, 5.0}};
    query.features = query.gradients = true;
    const auto analytic = run_alone(*small, query);
    ASSERT_TRUE(analytic.status.ok()) << analytic.status.text();
    EXPECT_GT(analytic.width, 1400U);
    check_cells(shape.oracle(), query, analytic, 5000);
    query.features = false;
    query.gradient = GradientMethod::central_differences;
    const auto differences = run_alone(*small, query);
    check_differences(shape.oracle(), differences);
    query.gradient = GradientMethod::blended;
    check_blended(differences, run_alone(*small, query));
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
