#include <tests/query/check.hpp>
#include <tests/query/device_pairs.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/numbers.hpp>
#include <tests/support/pair_tables.hpp>

#include <optional>
#include <utility>
#include <vector>

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

TEST_F(Lifetime, AContextMayGoBeforeWhatIsMadeOfIt) {
    for (const Technique technique : {Technique::cpu, Technique::compute}) {
        SCOPED_TRACE(to_string(technique));
        std::optional<Context> made(std::move(*Context::create(host_device(), on_demand())));
        std::optional<World> world(std::in_place, *made);
        const ShapeHandle square = *made->add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        const Expected<InstanceHandle> moving = world->add({.shape = square});
        ASSERT_TRUE(moving.has_value() && world->add({.shape = square, .pose = {{0.5, 0.0}}}));
        std::optional<PairTable<PenetrationQuery>> updated(
            std::in_place, PenetrationQuery{.tolerance = 0.05},
            PairTableOptions{.hits_only = true, .technique = technique});
        ASSERT_TRUE(world->update(*updated).ok());
        const std::vector<double> before = numbers_of_table(*updated);
        std::optional<PairTable<PenetrationQuery>> submitted(
            std::in_place, PenetrationQuery{.tolerance = 0.05}, updated->options());
        ASSERT_TRUE(world->submit(*submitted).ok());
        std::optional<WorldRequest> request(std::in_place);
        const Segment segment{{-1.0, 0.5}, {2.0, 0.5}};
        ASSERT_TRUE(world->submit(*request, {&segment, 1}, {.technique = technique}).ok());
        made.reset();

        EXPECT_EQ(numbers_of_table(*updated), before);
        EXPECT_TRUE(submitted->collect().ok());
        EXPECT_EQ(numbers_of_table(*submitted), before);
        ASSERT_TRUE(world->move(*moving, {{0.1, 0.0}}).ok());
        EXPECT_TRUE(world->update(*updated).ok());
        EXPECT_EQ(updated->size(), 2U);
        EXPECT_NE(numbers_of_table(*updated), before);
        world.reset();
        RayHit hit;
        EXPECT_TRUE(request->collect({&hit, 1}).ok());
        EXPECT_EQ(hit.parameter, 1.0 / 3.0);
        EXPECT_EQ(updated->size(), 2U);
        updated.reset();
        submitted.reset();
        request.reset();
    }
}

}  // namespace
}  // namespace nearfield::test
