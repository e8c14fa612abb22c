#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 1999;

class Lifetime : public QueryTest {};

void expect_same(const PenetrationResult& a, const PenetrationResult& b) {
    ASSERT_TRUE(a.status.ok() && b.status.ok());
    EXPECT_EQ(a.intersects, b.intersects);
    ASSERT_EQ(a.records.size(), b.records.size());
    for (std::size_t i = 0; i < a.records.size(); ++i) {
        EXPECT_EQ(a.records[i].point, b.records[i].point);
        EXPECT_EQ(a.records[i].depth, b.records[i].depth);
    }
}

TEST_F(Lifetime, AnUpdatedShapeIsAsGoodAsNew) {
    Random random(seed);
    const Rings first = star(random, 10, 0.4);
    Expected<ShapeHandle> changing = context().add_shape(first);
    Expected<ShapeHandle> still = context().add_shape(coast(random, 400, 0.5));
    ASSERT_TRUE(changing.ok() && still.ok());
    for (const int n : {5, 300, 40, 3000, 7}) {
        SCOPED_TRACE(n);
        const Rings now = scaled_and_moved(star(random, n, 0.3), 1.0, {0.1 * n / 300, 0.2});
        ASSERT_TRUE(context().update_shape(changing.value(), now).ok());
        Expected<ShapeHandle> fresh = context().add_shape(now);
        ASSERT_TRUE(fresh.ok());
        PenetrationQuery query;
        query.technique = Technique::raster;
        query.tolerance = 0.03;
        for (const bool as_a : {true, false}) {
            const auto ask = [&](ShapeHandle shape) {
                query.a.shape = as_a ? shape : still.value();
                query.b.shape = as_a ? still.value() : shape;
                return run_alone(context(), query);
            };
            expect_same(ask(changing.value()), ask(fresh.value()));
        }
        EXPECT_TRUE(context().remove_shape(fresh.value()).ok());
    }
    EXPECT_TRUE(context().remove_shape(changing.value()).ok());
    EXPECT_TRUE(context().remove_shape(still.value()).ok());
}

TEST_F(Lifetime, ARemovedShapeStaysUnknown) {
    const Rings square = rectangle({0, 0}, {1, 1});
    Expected<ShapeHandle> removed = context().add_shape(square);
    ASSERT_TRUE(removed.ok());
    ASSERT_TRUE(context().remove_shape(removed.value()).ok());
    // The next shape may reuse the memory, but not the handle.
    Expected<ShapeHandle> next = context().add_shape(square);
    ASSERT_TRUE(next.ok());
    EXPECT_FALSE(next.value() == removed.value());
    EXPECT_EQ(context().remove_shape(removed.value()).code(), StatusCode::unknown_shape);
    EXPECT_EQ(context().update_shape(removed.value(), square).code(), StatusCode::unknown_shape);
    EXPECT_EQ(context().remove_shape({}).code(), StatusCode::unknown_shape);
    PenetrationQuery query;
    query.technique = Technique::raster;
    query.a.shape = removed.value();
    query.b.shape = next.value();
    query.tolerance = 0.1;
    EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::unknown_shape);
    EXPECT_TRUE(context().remove_shape(next.value()).ok());
}

TEST_F(Lifetime, AHeadlessContextAnswersLikeAHostedOne) {
    Expected<Context> made = Context::create_headless();
    ASSERT_TRUE(made.ok()) << made.status().text();
    Context headless = std::move(made.value());
    EXPECT_FALSE(headless.device_name().empty());
    for (const Pair& pair : family_pairs(seed)) {
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
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.status().code(), StatusCode::no_device);
    EXPECT_NE(made.status().text().find(options.device_name), std::string::npos);
}

TEST_F(Lifetime, TwoContextsOnOneDeviceDoNotMeet) {
    Expected<Context> second = Context::create(host_device(), drawing());
    ASSERT_TRUE(second.ok()) << second.status().text();
    const std::vector<Pair> pairs = family_pairs(seed + 1);
    for (std::size_t i = 0; i < 4; ++i) {
        const PlacedPair here(context(), pairs[i]);
        const PlacedPair there(second.value(), pairs[i]);
        expect_same(run_alone(context(), here.penetration()),
                    run_alone(second.value(), there.penetration()));
    }
}

TEST_F(Lifetime, TheGraphDescribesItself) {
    Expected<Context> fresh = Context::create(host_device(), drawing());
    ASSERT_TRUE(fresh.ok()) << fresh.status().text();
    EXPECT_TRUE(fresh->describe_graph(GraphFormat::text).empty());
    const PlacedPair pair(fresh.value(), family_pairs(seed)[3]);
    ASSERT_TRUE(run_alone(fresh.value(), pair.penetration()).status.ok());
    EXPECT_FALSE(fresh->describe_graph(GraphFormat::text).empty());
    EXPECT_NE(fresh->describe_graph(GraphFormat::graphviz).find("digraph"), std::string::npos);
}

}  // namespace
}  // namespace nearfield::test
