#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/pair_tables.hpp>

namespace nearfield::test {
namespace {

constexpr std::uint64_t lifetime_seed = 1999;

class Lifetime : public QueryTest {};

void expect_same(const PenetrationResult& a, const PenetrationResult& b) {
    ASSERT_TRUE(a.status.ok() && b.status.ok());
    EXPECT_EQ(a.intersects, b.intersects);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        EXPECT_EQ(a.points[i].position, b.points[i].position);
        EXPECT_EQ(a.points[i].depth, b.points[i].depth);
    }
}

TEST_F(Lifetime, AnUpdatedShapeIsAsGoodAsNew) {
    Random random(lifetime_seed);
    const Rings first = star(random, 10, 0.4);
    Expected<ShapeHandle> changing = context().add_shape(first);
    Expected<ShapeHandle> still = context().add_shape(coast(random, 400, 0.5));
    ASSERT_TRUE(changing.has_value() && still.has_value());
    for (const int n : {5, 300, 40, 3000, 7}) {
        SCOPED_TRACE(n);
        const Rings now = scaled_and_moved(star(random, n, 0.3), 1.0, {0.1 * n / 300, 0.2});
        ASSERT_TRUE(context().update_shape(*changing, now).ok());
        Expected<ShapeHandle> fresh = context().add_shape(now);
        ASSERT_TRUE(fresh.has_value());
        PenetrationQuery query;
        query.technique = Technique::raster;
        query.tolerance = 0.03;
        for (const bool as_a : {true, false}) {
            const auto ask = [&](ShapeHandle shape) {
                query.a.shape = as_a ? shape : *still;
                query.b.shape = as_a ? *still : shape;
                return run_alone(context(), query);
            };
            expect_same(ask(*changing), ask(*fresh));
        }
        EXPECT_TRUE(context().remove_shape(*fresh).ok());
    }
    EXPECT_TRUE(context().remove_shape(*changing).ok());
    EXPECT_TRUE(context().remove_shape(*still).ok());
}

TEST_F(Lifetime, ThePointsOfAFieldMayChangeOnceItIsSubmitted) {
    Random random(lifetime_seed);
    const Expected<ShapeHandle> shape = context().add_shape(star(random, 20, 0.4));
    ASSERT_TRUE(shape.has_value());
    std::vector<Vector2> points{{0.1, 0.2}, {2.0, -1.0}, {-0.5, 0.6}};
    for (const Technique technique : {Technique::cpu, Technique::raster, Technique::compute}) {
        SCOPED_TRACE(to_string(technique));
        DistanceFieldQuery query;
        query.b.shape = *shape;
        query.rectangle = Rectangle{{-3.0, -3.0}, {3.0, 3.0}};
        query.tolerance = 0.02;
        query.technique = technique;
        query.points = points;
        const DistanceFieldResult asked = run_alone(context(), query);
        Batch batch;
        const auto field = batch.add(query);
        const Expected<Ticket> ticket = context().submit(batch);
        ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
        const std::vector<Vector2> before = points;
        for (Vector2& point : points) {
            point = {1.5 * point.y, point.x - 0.3};
        }
        Results results;
        const Status status = context().collect(*ticket, results);
        ASSERT_TRUE(status.ok()) << status.text();
        points = before;
        const DistanceFieldResult& result = results[field];
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        ASSERT_EQ(result.points.size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(result.points[i].position, asked.points[i].position) << i;
            EXPECT_EQ(result.points[i].distance, asked.points[i].distance) << i;
        }
    }
    EXPECT_TRUE(context().remove_shape(*shape).ok());
}

TEST_F(Lifetime, ARemovedShapeStaysUnknown) {
    const Rings square = rectangle({0, 0}, {1, 1});
    Expected<ShapeHandle> removed = context().add_shape(square);
    ASSERT_TRUE(removed.has_value());
    ASSERT_TRUE(context().remove_shape(*removed).ok());
    // The next shape may reuse the memory, but not the handle.
    Expected<ShapeHandle> next = context().add_shape(square);
    ASSERT_TRUE(next.has_value());
    EXPECT_FALSE(*next == *removed);
    EXPECT_EQ(context().remove_shape(*removed).code(), StatusCode::unknown_shape);
    EXPECT_EQ(context().update_shape(*removed, square).code(), StatusCode::unknown_shape);
    EXPECT_EQ(context().remove_shape({}).code(), StatusCode::unknown_shape);
    PenetrationQuery query;
    query.technique = Technique::raster;
    query.a.shape = *removed;
    query.b.shape = *next;
    query.tolerance = 0.1;
    EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::unknown_shape);
    EXPECT_TRUE(context().remove_shape(*next).ok());
}

TEST_F(Lifetime, AHeadlessContextAnswersLikeAHostedOne) {
    Expected<Context> made = Context::create_headless();
    ASSERT_TRUE(made.has_value()) << made.error().text();
    Context headless = std::move(*made);
    EXPECT_FALSE(headless.device_name().empty());
    for (const Pair& pair : family_pairs(lifetime_seed)) {
        SCOPED_TRACE(describe(pair));
        const PlacedPair placed(headless, pair);
        check_penetration(placed, PenetrationPoints::boundary,
                          run_alone(headless, placed.penetration()));
    }
}

TEST_F(Lifetime, AHeadlessContextNamesTheDeviceItCannotFind) {
    HeadlessOptions options;
    options.device_name = "no device is called this";
    const Expected<Context> made = Context::create_headless(options);
    ASSERT_FALSE(made.has_value());
    EXPECT_EQ(made.error().code(), StatusCode::no_device);
    EXPECT_NE(made.error().text().find(options.device_name), std::string::npos);
}

TEST_F(Lifetime, TwoContextsOnOneDeviceDoNotMeet) {
    Expected<Context> second = Context::create(host_device(), on_demand());
    ASSERT_TRUE(second.has_value()) << second.error().text();
    const std::vector<Pair> pairs = family_pairs(lifetime_seed + 1);
    for (std::size_t i = 0; i < 4; ++i) {
        const PlacedPair here(context(), pairs[i]);
        const PlacedPair there(*second, pairs[i]);
        expect_same(run_alone(context(), here.penetration()),
                    run_alone(*second, there.penetration()));
    }
}

TEST_F(Lifetime, TheGraphDescribesItself) {
    Expected<Context> fresh = Context::create(host_device(), on_demand());
    ASSERT_TRUE(fresh.has_value()) << fresh.error().text();
    EXPECT_TRUE(describe_graph(*fresh, GraphFormat::text)->empty());
    const PlacedPair pair(*fresh, family_pairs(lifetime_seed)[3]);
    ASSERT_TRUE(run_alone(*fresh, pair.penetration()).status.ok());
    const auto begins = [&](const char* text, GraphFormat format) {
        const Expected<std::string> graph = describe_graph(*fresh, format);
        EXPECT_EQ(graph->rfind(text, 0), 0U) << *graph;
    };
    begins("tiles: passes\n", GraphFormat::text);
    begins("digraph \"tiles\" {", GraphFormat::graphviz);
    PenetrationQuery by_compute = pair.penetration();
    by_compute.technique = Technique::compute;
    ASSERT_TRUE(run_alone(*fresh, by_compute).status.ok());
    begins("search for points: passes\n", GraphFormat::text);  // and no longer the tiles before it
    Expected<World> world = World::create(*fresh);
    ASSERT_TRUE(world.has_value()) << world.error().text();
    for (const Instance& instance : {pair.instance_a(), pair.instance_b()}) {
        ASSERT_TRUE(world->add({.shape = instance.shape, .pose = instance.pose}).has_value());
    }
    PairTable<PenetrationQuery> table({.tolerance = pair.penetration().tolerance}, on_device);
    ASSERT_TRUE(world->update(table).ok());
    begins("boxes of pairs: passes\n", GraphFormat::text);
}

}  // namespace
}  // namespace nearfield::test
