#include <tests/query/field_laws.hpp>

#include <variant>

namespace nearfield::test {
namespace {

constexpr std::uint64_t compute_seed = 3141;

using ComputeFields = QueryTest;

TEST_F(ComputeFields, AreRefusedWhereTooManyEdgesAreEquallyNear) {
    const PlacedShape circle(context(), regular(300000), {});
    DistanceFieldQuery query;
    query.b = circle.instance();
    query.tolerance = 0.01;
    query.rectangle = Rectangle{{-0.01, -0.01}, {0.01, 0.01}};
    query.features = true;
    query.technique = Technique::compute;
    const DistanceFieldResult result = run_alone(context(), query);
    EXPECT_EQ(result.status.code(), StatusCode::too_large) << result.status.text();
    EXPECT_TRUE(result.values.empty() && result.features.empty());
    query.technique = Technique::cpu;
    EXPECT_TRUE(run_alone(context(), query).status.ok());
}

TEST_F(ComputeFields, BlendedGradientsAreRefusedByName) {
    const PlacedShape shape(context(), regular(5), {});
    DistanceFieldQuery query;
    query.b = shape.instance();
    query.tolerance = 0.1;
    query.rectangle = Rectangle{{-1, -1}, {1, 1}};
    query.gradients = true;
    query.gradient = GradientMethod::blended;
    query.technique = Technique::compute;
    const Status status = run_alone(context(), query).status;
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_NE(status.message().find("compute does not answer blended gradients"), std::string::npos)
        << status.message();
}

TEST_F(ComputeFields, PointsAfterTheRastersImagesAreGone) {
    // More kinds of batches than cached compiled graphs: images of the first ones are destroyed.
    Expected<Context> made = Context::create(host_device(), on_demand());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    Random random(compute_seed);
    const PlacedPair pair(
        *made,
        {{"A", star(random, 9, 0.5)}, {"B", star(random, 9, 0.5)}, {}, {{0.5, 0.2}, 0.0}, 0.05});
    const PenetrationResult drawn = run_alone(*made, pair.penetration());
    for (std::uint32_t set = 1; set < 1U << intersection_strategies; ++set) {
        Batch batch;
        for (std::uint32_t i = 0; i < intersection_strategies; ++i) {
            const auto strategy = static_cast<IntersectionStrategy>(i);
            if ((set >> i & 1U) != 0 && strategy != IntersectionStrategy::logic_op) {
                IntersectionQuery query = pair.intersection(IntersectionKind::volume_volume);
                query.strategy = strategy;
                batch.add(query);
                query.kind = IntersectionKind::boundary_boundary;
                batch.add(query);
            }
        }
        DistanceFieldQuery field{pair.instance_a(), pair.instance_b(), 0.05, std::nullopt};
        for (std::uint32_t encoding = 0; encoding < 3; ++encoding) {
            if ((set >> encoding & 1U) != 0) {
                field.sign = static_cast<SignEncoding>(encoding);
                batch.add(field);
            }
        }
        Results results;
        ASSERT_TRUE(made->run(batch, results).ok());
        PenetrationQuery computed = pair.penetration();
        computed.technique = Technique::compute;
        // Two in flight, so that descriptor sets are inspected while images are destroyed.
        Batch points;
        points.add(computed);
        const Expected<Ticket> first = made->submit(points);
        const Expected<Ticket> second = made->submit(batch);
        ASSERT_TRUE(first.has_value() && second.has_value());
        ASSERT_TRUE(made->collect(*first, results).ok());
        EXPECT_EQ(std::get<PenetrationResult>(results.results.front()).count, drawn.count);
        ASSERT_TRUE(made->collect(*second, results).ok());
    }
}

TEST_F(ComputeFields, MasksCountTowardsTheMemoryLimit) {
    Settings settings;
    settings.memory_limit = std::uint64_t{64} << 20U;
    Expected<Context> small = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    const PlacedPair pair(
        *small, {{"A", rectangle({0, 0}, {1, 1})}, {"B", rectangle({0, 0}, {1, 1})}, {}, {}, 2e-5});
    IntersectionQuery query = pair.intersection(IntersectionKind::volume_volume);
    query.summary_only = true;
    query.technique = Technique::compute;
    Batch batch;
    batch.add(query);
    Results results;
    const Status refused = small->run(batch, results);
    EXPECT_EQ(refused.code(), StatusCode::too_large) << refused.text();
    EXPECT_EQ(results.timings.device, 0.0) << "refused after the work";
}

TEST_F(ComputeFields, TooFarAwayIsRefusedByEveryTechniqueBeforeTheWork) {
    const PlacedShape shape(context(), regular(5), {});
    for (const Technique technique : every_technique) {
        DistanceFieldQuery query;
        query.b = shape.instance();
        query.tolerance = 1e-3;
        query.rectangle = Rectangle{{1e5, 0.0}, {1e5 + 0.1, 0.1}};
        query.technique = technique;
        Batch batch;
        batch.add(query);
        Results results;
        ASSERT_TRUE(context().run(batch, results).ok());
        const Status status = std::get<DistanceFieldResult>(results.results.front()).status;
        EXPECT_EQ(status.code(), StatusCode::invalid_query) << status.text();
        EXPECT_NE(status.message().find("single precision"), std::string::npos) << status.text();
        EXPECT_EQ(results.timings.device, 0.0) << "refused after the work";
    }
}

}  // namespace
}  // namespace nearfield::test
