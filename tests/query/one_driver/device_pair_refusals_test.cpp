#include <tests/query/query_test.hpp>
#include <tests/support/pair_tables.hpp>

#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr PenetrationQuery penetrations{.tolerance = 0.1};
constexpr ContactQuery contacts{.tolerance = 0.1, .contact_distance = 0.1};

class DevicePairRefusals : public QueryTest {
protected:
    /// Updates a table with a world of two instances that overlap. The refusal names the call, and
    /// leaves no row.
    template <class Query>
    static void expect_refused(Context& context, const Query& query, StatusCode code) {
        PairTable<Query> table(query, on_device);
        update(context, table, code);
    }
    template <class Query>
    static void update(Context& context, PairTable<Query>& table, StatusCode code) {
        const Expected<ShapeHandle> shape = context.add_shape(rectangle({0, 0}, {4, 4}));
        ASSERT_TRUE(shape.has_value()) << shape.error().text();
        Expected<World> world = World::create(context);
        ASSERT_TRUE(world.has_value()) << world.error().text();
        for (const double x : {0.0, 2.0}) {
            ASSERT_TRUE(world->add({.shape = *shape, .pose = {{x, x}, 0.0}}).has_value());
        }
        const Status status = world->update(table);
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_EQ(table.size() > 0, code == StatusCode::ok);
        if (code != StatusCode::ok) {
            EXPECT_EQ(status.message().find("update: "), 0U) << status.text();
            EXPECT_EQ(table.candidates(), 0U);
            EXPECT_EQ(table.row(0).error().code(), StatusCode::invalid_query);
        }
    }
};

TEST_F(DevicePairRefusals, OfContextsThatDoNotCompute) {
    Settings settings;
    settings.techniques.compute = false;
    Expected<Context> drawing_only = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(drawing_only.has_value()) << drawing_only.error().text();
    expect_refused(*drawing_only, penetrations, StatusCode::unsupported_technique);
    expect_refused(*drawing_only, contacts, StatusCode::unsupported_technique);
    expect_refused(*drawing_only, IntersectionTestQuery{}, StatusCode::unsupported_technique);
    Expected<Context> without_device = Context::create_cpu();
    ASSERT_TRUE(without_device.has_value()) << without_device.error().text();
    expect_refused(*without_device, penetrations, StatusCode::unsupported_technique);
    expect_refused(*without_device, IntersectionTestQuery{}, StatusCode::unsupported_technique);
}

/// The walk that finds them would take more turns than a loop of a shader may.
TEST_F(DevicePairRefusals, OfOneAmongTooManyOthers) {
    const Expected<ShapeHandle> shape = context().add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(shape.has_value()) << shape.error().text();
    const Expected<ShapeHandle> floor = context().add_shape(rectangle({0, 0}, {600, 600}));
    ASSERT_TRUE(floor.has_value()) << floor.error().text();
    Expected<World> world = World::create(context());
    ASSERT_TRUE(world.has_value()) << world.error().text();
    ASSERT_TRUE(world->add({.shape = *floor}).has_value());
    for (int i = 0; i < 62000; ++i) {
        const Pose pose{{2.0 * (i % 250), 2.0 * (i / 250)}, 0.0};
        ASSERT_TRUE(world->add({.shape = *shape, .pose = pose}).has_value());
    }
    PairTable table(IntersectionTestQuery{}, on_device);
    const Status status = world->update(table);
    EXPECT_EQ(status.code(), StatusCode::too_large) << status.text();
    EXPECT_NE(status.message().find("overlaps with those of some 50,000 others"), std::string::npos)
        << status.text();
}

TEST_F(DevicePairRefusals, OfQueriesThatAreNotForTheDeviceToCompute) {
    for (const Technique technique : {Technique::cpu, Technique::raster}) {
        expect_refused(context(), PenetrationQuery{.tolerance = 0.1, .technique = technique},
                       StatusCode::invalid_query);
        expect_refused(context(), IntersectionTestQuery{.technique = technique},
                       StatusCode::invalid_query);
    }
    const BufferTarget target;
    expect_refused(context(),
                   PenetrationQuery{.tolerance = 0.1, .on_device = true, .target = &target},
                   StatusCode::invalid_query);
    expect_refused(context(), PenetrationQuery{.tolerance = -1.0}, StatusCode::invalid_query);
    expect_refused(context(), ContactQuery{.tolerance = 0.1}, StatusCode::invalid_query);
}

/// Rows of an earlier update do not stay.
TEST_F(DevicePairRefusals, LeaveATableThatWasFilledEmpty) {
    PairTable<PenetrationQuery> table({.tolerance = 0.1}, on_device);
    update(context(), table, StatusCode::ok);
    Expected<Context> without_device = Context::create_cpu();
    ASSERT_TRUE(without_device.has_value()) << without_device.error().text();
    update(*without_device, table, StatusCode::unsupported_technique);
    table = PairTable<PenetrationQuery>({.tolerance = 0.1}, on_device);
}

TEST_F(DevicePairRefusals, BeyondTheMemoryLimit) {
    Settings settings;
    settings.memory_limit = 1U << 21U;
    Expected<Context> limited = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(limited.has_value());
    Random random(20260);
    const auto shape = limited->add_shape(star(random, 50, 0.5));
    ASSERT_TRUE(shape.has_value());
    Expected<World> world = World::create(*limited);
    ASSERT_TRUE(world.has_value());
    std::vector<InstanceHandle> handles;
    for (int i = 0; i < 300; ++i) {
        const auto handle =
            world->add({.shape = *shape,
                        .pose = {{random.between(-1.0, 1.0), random.between(-1.0, 1.0)},
                                 random.between(-4.0, 4.0)}});
        ASSERT_TRUE(handle.has_value());
        handles.push_back(*handle);
    }
    PairTable table(PenetrationQuery{.tolerance = 0.01}, on_device);
    const Status status = world->update(table);
    EXPECT_EQ(status.code(), StatusCode::too_large) << status.message();
    EXPECT_NE(status.message().find("memory_limit"), std::string::npos) << status.message();
    EXPECT_EQ(table.size(), 0U);
    for (std::size_t i = 2; i < handles.size(); ++i) {
        ASSERT_TRUE(world->remove(handles[i]).ok());
    }
    EXPECT_TRUE(world->update(table).ok());
}

/// Buffers start small where the usual ones do not fit.
TEST_F(DevicePairRefusals, AreNoneWithinALimitBelowTheUsualRoom) {
    Settings settings;
    settings.memory_limit = 1U << 17U;
    Expected<Context> limited = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(limited.has_value()) << limited.error().text();
    const auto shape = limited->add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
    ASSERT_TRUE(shape.has_value());
    Expected<World> world = World::create(*limited);
    ASSERT_TRUE(world.has_value());
    for (const double x : {0.0, 0.5}) {
        ASSERT_TRUE(world->add({.shape = *shape, .pose = {{x, x}, 0.0}}).has_value());
    }
    PairTable table(PenetrationQuery{.tolerance = 0.01}, on_device);
    const Status status = world->update(table);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(table.size(), 2U);
}

}  // namespace
}  // namespace nearfield::test
