#include <tests/query/all_numbers.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t compute_intersection_seed = 4711;

/// Masks that the device makes from the shapes' own edges, against the oracle.
class ComputeIntersections : public QueryTest {
protected:
    static void check(Context& context, Pair pair) {
        const PlacedPair placed(context, std::move(pair), Technique::compute);
        SCOPED_TRACE(placed.pair().a.name + " and " + placed.pair().b.name);
        for (const IntersectionKind kind : every_kind) {
            SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)));
            IntersectionQuery query = placed.intersection(kind);
            const IntersectionResult result = run_alone(context, query);
            EXPECT_EQ(result.technique, Technique::compute);
            EXPECT_GT(result.count, 0U);
            check_intersection(placed, kind, result);
            query.summary_only = true;
            const IntersectionResult counted = run_alone(context, query);
            EXPECT_EQ(counted.count, result.count);
            EXPECT_EQ(counted.box.min, result.box.min);
            EXPECT_EQ(counted.box.max, result.box.max);
        }
    }
    static void check(Pair pair) { check(context(), std::move(pair)); }
};

TEST_F(ComputeIntersections, HoldForHolesAndIslands) {
    Random random(compute_intersection_seed);
    for (int i = 0; i < 6; ++i) {
        check({{"holes", with_holes(random, 40)},
               {"parts", several_parts(random, 40)},
               {{}, random.between(0.0, 6.0)},
               {{random.between(-0.4, 0.4), 0.1}, random.between(0.0, 6.0)},
               0.015});
    }
}

TEST_F(ComputeIntersections, HoldFarFromEveryOrigin) {
    Random random(compute_intersection_seed);
    const Rings a = with_holes(random, 20);
    const Rings b = coast(random, 2000, 0.5);
    const Vector2 far{1e6, -2e6};
    check({{"A", a}, {"B", b}, {far, 0.7}, {{far.x + 0.4, far.y + 0.2}, 2.0}, 0.02});
    // By their own coordinates.
    check({{"far A", scaled_and_moved(a, 1.0, far)},
           {"far B", scaled_and_moved(b, 1.0, {far.x - 0.3, far.y + 0.2})},
           {},
           {},
           0.02});
    // Shapes of millions of cells, of which a few are common.
    const Rings square = rectangle({-1e6, -1e6}, {0.3, 0.2});
    check({{"large", square}, {"small", star(random, 30, 0.5)}, {}, {}, 0.05});
    const Rings strip = rectangle({-2.0, -0.4}, {1e6, 0.5});
    check({{"large", square}, {"long", strip}, {}, {{}, 0.7}, 0.05});
}

/// Most of a thousand rows, or columns, which each of many edges spans.
TEST_F(ComputeIntersections, HoldForLongEdgesInALargeTile) {
    for (const double angle : {0.0, 1.5}) {
        check({{"comb", comb(60)}, {"comb", comb(70)}, {{}, angle}, {{0.1, 0.05}, angle}, 0.0015});
    }
}

TEST_F(ComputeIntersections, HoldOverManyTileBatches) {
    Expected<Context> small =
        Context::create(host_device(), on_demand({.memory_limit = 12U << 20U}));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    Random random(compute_intersection_seed);
    check(*small, {{"A", scaled_and_moved(with_holes(random, 5), 10.0, {})},
                   {"B", scaled_and_moved(star(random, 40, 0.6), 10.0, {})},
                   {},
                   {{1.0, 0.5}, 0.2},
                   0.052});
}

TEST_F(ComputeIntersections, AreTheSameBitsInEveryRun) {
    Random random(compute_intersection_seed);
    const PlacedPair first(context(), any_pair(random), Technique::compute);
    const PlacedPair second(context(),
                            {{"A", coast(random, 3000, 0.5)},
                             {"B", with_holes(random, 9)},
                             {},
                             {{0.2, 0.1}, 1.0},
                             0.01},
                            Technique::compute);
    Batch batch;
    for (const IntersectionKind kind : every_kind) {
        batch.add(second.intersection(kind));
        batch.add(first.intersection(kind));
    }
    Results once;
    ASSERT_TRUE(context().run(batch, once).ok());
    for (int i = 0; i < 5; ++i) {
        Results again;
        ASSERT_TRUE(context().run(batch, again).ok());
        EXPECT_EQ(all_numbers(again), all_numbers(once));
    }
}

/// Samples for which there was no room are collected again, when other shapes may be kept.
TEST_F(ComputeIntersections, StayAsTheyAreWhileOtherBatchesAreSubmitted) {
    const Rings square = rectangle({-1.0, -1.0}, {1.0, 1.0});
    IntersectionQuery query;
    query.tolerance = 0.01;
    query.kind = IntersectionKind::volume_volume;
    query.technique = Technique::compute;
    DistanceFieldQuery field;
    field.tolerance = 0.02;
    field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
    field.technique = Technique::compute;
    std::vector<std::vector<double>> answers;
    for (const char* const meanwhile : {"nothing", "another shape", "a new outline"}) {
        SCOPED_TRACE(meanwhile);
        Expected<Context> made = Context::create(host_device(), on_demand());
        ASSERT_TRUE(made.has_value()) << made.error().text();
        query.a.shape = query.b.shape = field.b.shape = *made->add_shape(square);
        Batch batch;
        batch.add(query);
        batch.add(field);
        const Expected<Ticket> ticket = made->submit(batch);
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        if (meanwhile == std::string("another shape")) {
            Random random(compute_intersection_seed);
            query.a.shape = *made->add_shape(star(random, 100, 0.5));
        } else if (meanwhile == std::string("a new outline")) {
            Random random(compute_intersection_seed);
            ASSERT_TRUE(made->update_shape(query.a.shape, star(random, 100, 0.5)).ok());
        }
        Batch later;
        later.add(query);
        const Expected<Ticket> second = made->submit(later);
        ASSERT_TRUE(second.has_value()) << second.error().text();
        Results results;
        ASSERT_TRUE(made->collect(*ticket, results).ok());
        EXPECT_GT(std::get<IntersectionResult>(results.results[0]).count, 20000U);
        answers.push_back(all_numbers(results));
        EXPECT_EQ(answers.back(), answers.front());
        ASSERT_TRUE(made->collect(*second, results).ok());
    }
}

/// Two shapes of which each fits, but not both: shapes of earlier batches make room.
TEST_F(ComputeIntersections, OfLargeShapesDoNotDependOnThoseBefore) {
    const auto circle = [](int edges) {
        Ring ring;
        for (int i = 0; i < edges; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / edges;
            ring.push_back({std::cos(angle), std::sin(angle)});
        }
        return Rings{ring};
    };
    test_support::Lies lies;
    lies.properties = [](VkPhysicalDeviceProperties& properties) {
        properties.limits.maxStorageBufferRange = 1U << 20U;
    };
    const test_support::FakeLoader loader(host_device(), std::move(lies));
    Expected<Context> made = Context::create(loader.host(), on_demand());
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const ShapeHandle square = *made->add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    IntersectionQuery query;
    query.b.shape = square;
    query.tolerance = 0.1;
    query.kind = IntersectionKind::volume_volume;
    query.technique = Technique::compute;
    const auto count_of = [&](ShapeHandle shape) {
        query.a.shape = shape;
        const IntersectionResult result = run_alone(*made, query);
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        return result.count;
    };
    constexpr int many = 16'000;
    const ShapeHandle first = *made->add_shape(circle(many));
    const ShapeHandle second = *made->add_shape(circle(many));
    const std::uint64_t count = count_of(first);
    EXPECT_GT(count, 100U);
    EXPECT_EQ(count_of(second), count);
    EXPECT_EQ(count_of(first), count);
    // What grows gets more room than it needs, elsewhere.
    ASSERT_TRUE(made->update_shape(first, circle(many + 8)).ok());
    EXPECT_EQ(count_of(first), count);
    // Where one does not fit at all, it is refused by itself.
    query.a.shape = *made->add_shape(circle(2 * many));
    Batch batch;
    batch.add(query);
    query.a.shape = square;
    batch.add(query);
    Results results;
    ASSERT_TRUE(made->run(batch, results).ok());
    const Status& status = std::get<IntersectionResult>(results.results[0]).status;
    EXPECT_TRUE(status.ok() || status.code() == StatusCode::too_large) << status.text();
    EXPECT_TRUE(std::get<IntersectionResult>(results.results[1]).status.ok());
}

}  // namespace
}  // namespace nearfield::test
