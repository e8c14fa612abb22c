#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/pair_tables.hpp>

namespace nearfield::test {
namespace {

constexpr std::uint64_t lifetime_seed = 1999;

class Lifetime : public QueryTest {};

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
