// Tables of the pairs that a world finds, or that are listed: against a batch, bit for bit.

#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

/// True if the filters of both let them be a pair.
bool are_paired(Scene& scene, InstanceHandle a, InstanceHandle b) {
    const WorldInstance one = *scene.world().instance(a);
    const WorldInstance other = *scene.world().instance(b);
    return (one.category & other.mask) != 0 && (other.category & one.mask) != 0;
}

/// Whether a table of hits alone has the row.
template <class Query>
bool is_hit(const PairRow<Query>& row, double reach) {
    if (row.status != StatusCode::ok) {
        return true;
    }
    if constexpr (std::is_same_v<Query, PenetrationQuery>) {
        return row.count > 0;
    } else if constexpr (requires { row.inside; }) {
        return row.inside;
    } else if constexpr (requires { row.distance; }) {
        return row.distance <= reach;
    } else if constexpr (requires { row.count; }) {
        return row.intersects || row.count > 0;
    } else {
        return row.intersects;
    }
}

/// Expects of a table of hits that it has the hits among the rows of the other.
template <class Query>
void expect_hits(PairTable<Query>& hits, PairTable<Query>& all) {
    std::uint32_t next = 0;
    for (const PairRow<Query>& row : all.rows()) {
        if (is_hit(row, all.options().reach)) {
            ASSERT_LT(next, hits.size());
            EXPECT_EQ(hits.rows()[next].a, row.a);
            EXPECT_EQ(hits.rows()[next].b, row.b);
            EXPECT_EQ(hits.rows()[next].index, next);
            ++next;
        }
    }
    EXPECT_EQ(next, hits.size());
}

/// Every row is the answer to the query of its pair.
template <class Query>
void expect_rows_of_batch(Scene& scene, PairTable<Query>& table) {
    for (const PairRow<Query>& row : table.rows()) {
        SCOPED_TRACE("row " + std::to_string(row.index));
        Query query = table.query();
        query.technique = Technique::cpu;
        const WorldInstance a = *scene.world().instance(row.a);
        const WorldInstance b = *scene.world().instance(row.b);
        query.a = {a.shape, a.pose};
        query.b = {b.shape, b.pose};
        const auto answer = scene.context().answer(query);
        ASSERT_EQ(row.status, answer.has_value() ? StatusCode::ok : answer.error().code());
        if (answer.has_value()) {
            Numbers found;
            Numbers expected;
            found.add_answer(table, row);
            expected.add_answer(*answer);
            EXPECT_EQ(found.list(), expected.list());
        }
    }
}

using WorldTables = ScenesTest;

TEST_P(WorldTables, AreThoseOfABatch) {
    for_each_scene(1, 31, [](Scene& scene, Random& /*random*/) {
        for_each_query_of_pairs([&](const char* name, const auto& query, double reach) {
            SCOPED_TRACE(name);
            PairTable all(query, {.reach = reach});
            PairTable hits(query, {.reach = reach, .hits_only = true});
            ASSERT_TRUE(scene.world().update(all).ok());
            ASSERT_TRUE(scene.world().update(hits).ok());
            EXPECT_EQ(all.left_to_cpu(), all.candidates());
            expect_hits(hits, all);
            for (const auto& row : all.rows()) {
                EXPECT_TRUE(are_paired(scene, row.a, row.b));
            }
            expect_rows_of_batch(scene, all);
            expect_rows_of_batch(scene, hits);
        });
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldTables,
                         testing::Values(SceneKind::ordinary, SceneKind::every_family,
                                         SceneKind::grid, SceneKind::holes));

/// The rows of a list are those of its pairs, in order; of hits alone, they are some of these.
template <class Query>
void expect_rows_of_list(Scene& scene, const Query& query, const std::vector<InstanceHandle>& a,
                         const std::vector<InstanceHandle>& b) {
    PairTable table(query, of_list);
    const Status status = scene.world().update(table, {.a = a, .b = b});
    ASSERT_TRUE(status.ok()) << status.text();
    const auto rows = table.rows();
    ASSERT_EQ(rows.size(), a.size());
    EXPECT_EQ(table.candidates(), a.size());
    PairTable hits(query, {.hits_only = true, .listed = true});
    ASSERT_TRUE(scene.world().update(hits, {.a = a, .b = b}).ok());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].a, a[i]);
        EXPECT_EQ(rows[i].b, b[i]);
        EXPECT_EQ(rows[i].index, i);
    }
    expect_hits(hits, table);
    expect_rows_of_batch(scene, table);
    expect_rows_of_batch(scene, hits);
}

using WorldListedPairs = ScenesTest;

TEST_P(WorldListedPairs, AreThoseOfABatch) {
    for_each_scene(3, 83, [](Scene& scene, Random& random) {
        const auto any = [&] {
            return scene.handle(
                static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.size()) - 1)));
        };
        // In any order; some with itself, and some in both directions, one after the other.
        std::vector<InstanceHandle> a;
        std::vector<InstanceHandle> b;
        for (int pair = 0; pair < 150; ++pair) {
            a.push_back(any());
            b.push_back(any());
            if (random.whole(0, 2) == 0) {
                a.push_back(b.back());
                b.push_back(a[a.size() - 2]);
            }
        }
        expect_rows_of_list(scene, IntersectionTestQuery{}, a, b);
        // Of the largest shapes, as few samples as there is memory for.
        const double tolerance = GetParam() == SceneKind::extreme ? 1e6 : 0.05;
        for (const bool records : {false, true}) {
            PenetrationQuery query{.tolerance = 0.05, .points = PenetrationPoints::vertices};
            query.summary_only = !records;
            expect_rows_of_list(scene, query, a, b);
            query.tolerance = tolerance;
            query.points = PenetrationPoints::boundary;
            expect_rows_of_list(scene, query, a, b);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldListedPairs, testing::ValuesIn(all_scene_kinds()));

TEST(PairTables, HaveTheRowsOfTheBroadPhaseInOrder) {
    Scene scene(make_scene(SceneKind::ordinary, 3));
    std::vector<Instance> instances;
    for (std::size_t i = 0; i < scene.size(); ++i) {
        instances.push_back(scene.instance(i));
    }
    const auto pairs = scene.context().find_overlapping_boxes(instances, 0.25);
    ASSERT_TRUE(pairs.has_value());
    PairTable once(IntersectionTestQuery{}, {0.25, false});
    ASSERT_TRUE(scene.world().update(once).ok());
    ASSERT_EQ(once.rows().size(), pairs->size());
    for (std::size_t i = 0; i < pairs->size(); ++i) {
        EXPECT_EQ(scene.position(once.rows()[i].a), (*pairs)[i].first);
        EXPECT_EQ(scene.position(once.rows()[i].b), (*pairs)[i].second);
    }
    SeparationVectorQuery query;
    query.tolerance = 0.1;
    PairTable both_ways(query, {0.25, false});
    ASSERT_TRUE(scene.world().update(both_ways).ok());
    EXPECT_EQ(both_ways.rows().size(), 2 * pairs->size());
    EXPECT_TRUE(std::is_sorted(
        both_ways.rows().begin(), both_ways.rows().end(), [&](const auto& one, const auto& other) {
            return std::pair(scene.position(one.a), scene.position(one.b)) <
                   std::pair(scene.position(other.a), scene.position(other.b));
        }));
}

TEST(PairTables, StartAnewInAnotherWorld) {
    PairTable table(IntersectionTestQuery{});
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        // Each world comes to have the address of the one before.
        Scene scene(make_scene(SceneKind::ordinary, seed));
        ASSERT_TRUE(scene.world().update(table).ok());
        EXPECT_EQ(table.left_to_cpu(), table.candidates());
        PairTable anew(IntersectionTestQuery{});
        ASSERT_TRUE(scene.world().update(anew).ok());
        EXPECT_EQ(rows_of(table), rows_of(anew));
    }
}

/// As tables that the device fills: there are rows once they are collected, of the world as it was.
TEST(PairTables, AreSubmittedAndCollected) {
    Scene scene(make_scene(SceneKind::ordinary, 2));
    const PenetrationQuery query{.tolerance = 0.05};
    PairTable at_once(query);
    ASSERT_TRUE(scene.world().update(at_once).ok());
    ASSERT_GT(at_once.size(), 0U);
    PairTable table(query);
    EXPECT_EQ(table.collect().code(), StatusCode::not_ready);
    EXPECT_FALSE(table.is_ready());
    ASSERT_TRUE(scene.world().submit(table).ok());
    EXPECT_TRUE(table.is_ready());
    EXPECT_EQ(table.size(), 0U);
    EXPECT_EQ(table.candidates(), 0U);
    EXPECT_TRUE(table.rows().empty());
    EXPECT_EQ(table.row(0).error().code(), StatusCode::invalid_query);
    ASSERT_TRUE(scene.world().move(scene.handle(0), {{1e3, 1e3}}).ok());
    for (const Status& status : {scene.world().submit(table), scene.world().update(table)}) {
        EXPECT_EQ(status.code(), StatusCode::not_ready);
        EXPECT_NE(status.message().find("has not been collected"), std::string::npos);
    }
    ASSERT_TRUE(table.collect().ok());
    EXPECT_FALSE(table.is_ready());
    EXPECT_EQ(rows_of(table), rows_of(at_once));
    EXPECT_EQ(table.left_to_cpu(), table.candidates());
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        EXPECT_EQ(table.row(i)->index, i);
        EXPECT_EQ(table.row(i)->count, table.rows()[i].count);
    }
    EXPECT_FALSE(table.row(table.size()).has_value());
    EXPECT_GE(table.timings().total, table.timings().decode);
    EXPECT_EQ(scene.world().record(table, {}).code(), StatusCode::invalid_submission);
    EXPECT_EQ(table.on_device().error().code(), StatusCode::invalid_query);
}

/// Reach is no property of a hit, but of distances.
TEST(PairTables, OfHitsDoNotDependOnTheReach) {
    Scene scene({{"left", rectangle({0, 0}, {1, 1}), {}},
                 {"right", rectangle({0, 0}, {1, 1}), {{0.5, 0.0}}},
                 {"near", rectangle({0, 0}, {1, 1}), {{2.0, 0.0}}}});
    for (const double reach : {0.0, 0.25, 0.5, 10.0}) {
        PairTable tests(IntersectionTestQuery{}, {.reach = reach, .hits_only = true});
        ASSERT_TRUE(scene.world().update(tests).ok());
        EXPECT_EQ(tests.size(), 1U);
        EXPECT_EQ(tests.candidates(), 1U);
        PairTable separations(SeparationQuery{.tolerance = 0.01},
                              {.reach = reach, .hits_only = true});
        ASSERT_TRUE(scene.world().update(separations).ok());
        EXPECT_EQ(separations.size(), reach < 0.5 ? 1U : reach < 1.0 ? 2U : 3U);
    }
}

TEST(PairTables, RefuseWhatAWorldCannotAnswer) {
    Scene scene(make_scene(SceneKind::ordinary, 0));
    for (const double reach : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
        PairTable far(IntersectionTestQuery{}, {.reach = reach});
        const Status status = scene.world().update(far);
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_NE(status.message().find("reach"), std::string::npos) << status.message();
    }
    PenetrationQuery query;
    query.tolerance = 0.05;
    query.technique = Technique::compute;
    PairTable on_device(query);
    EXPECT_EQ(scene.world().update(on_device).code(), StatusCode::invalid_query);
    PairTable by_raster(query, {.technique = Technique::raster});
    EXPECT_EQ(scene.world().update(by_raster).code(), StatusCode::invalid_query);
    PairTable all_by_device(PenetrationQuery{.tolerance = 0.05}, {.technique = Technique::compute});
    EXPECT_NE(scene.world().update(all_by_device).message().find("hits_only = false"),
              std::string::npos);
    PairTable contained(ContainmentQuery{}, {.hits_only = true, .technique = Technique::compute});
    EXPECT_NE(scene.world().update(contained).message().find("does not answer this query"),
              std::string::npos);
    PairTable still(IntersectionTestQuery{});
    const InstanceHandle moving[] = {scene.handle(0)};
    const Pose end[] = {{}};
    EXPECT_NE(
        scene.world().update(still, {.moving = moving, .ends = end}).message().find("motions"),
        std::string::npos);
    query.technique = Technique::automatic;
    query.on_device = true;
    PairTable resident(query);
    EXPECT_EQ(scene.world().update(resident).code(), StatusCode::invalid_query);
    query.on_device = false;
    query.tolerance = -1.0;
    PairTable wrong(query);
    const Status status = scene.world().update(wrong);
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_NE(status.message().find("tolerance"), std::string::npos) << status.message();
    EXPECT_TRUE(wrong.rows().empty());
}

TEST(PairTables, OfContactsReachAsFarAsTheContactDistance) {
    Scene scene(unit_squares({{4.0, 0.0}, {4.0, 1.25}}));
    PairTable near(ContactQuery{.tolerance = 0.01, .contact_distance = 0.5}, {.hits_only = true});
    ASSERT_TRUE(scene.world().update(near).ok());
    EXPECT_EQ(near.size(), 2U) << "contacts beyond the boxes are missing";
}

/// Three squares, each of which touches the next.
class WorldListedSquares : public testing::Test {
protected:
    Scene scene_{unit_squares({{0, 0}, {1, 0}, {2, 0}})};
};

TEST_F(WorldListedSquares, StateWhatIsWrongWithAPair) {
    const auto rounded = scene_.context().add_shape(rectangle({0, 0}, {1, 1}), 0.02);
    ASSERT_TRUE(rounded.has_value());
    const InstanceHandle far = *scene_.world().add({scene_.shape(0), {{1e6, 0.0}}});
    const InstanceHandle coarse = *scene_.world().add({*rounded, {{0.5, 0.0}}});
    const std::vector<InstanceHandle> a{scene_.handle(0), coarse, far, scene_.handle(1)};
    const std::vector<InstanceHandle> b{coarse, scene_.handle(1), far, scene_.handle(2)};
    for (const PenetrationPoints points :
         {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
        PenetrationQuery query{.tolerance = 0.03, .points = points};
        expect_rows_of_list(scene_, query, a, b);  // finer than the rounded one permits
        query.tolerance = 8e-7;                    // too fine for the far one
        expect_rows_of_list(scene_, query, {a[2], a[0], a[3]}, {b[0], a[2], b[3]});
        query.tolerance = 0.1;
        expect_rows_of_list(scene_, query, a, b);
    }
    ASSERT_TRUE(scene_.context().remove_shape(scene_.shape(1)).ok());
    const InstanceHandle first[] = {scene_.handle(0), scene_.handle(1), scene_.handle(2)};
    const InstanceHandle second[] = {scene_.handle(1), scene_.handle(2), scene_.handle(2)};
    PairTable penetrations(PenetrationQuery{.tolerance = 0.1, .summary_only = true}, of_list);
    PairTable tests(IntersectionTestQuery{}, of_list);
    const auto expect = [&](auto& table) {
        ASSERT_TRUE(scene_.world().update(table, {.a = first, .b = second}).ok());
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(table.rows()[i].status, i < 2 ? StatusCode::unknown_shape : StatusCode::ok);
            EXPECT_EQ(table.rows()[i].intersects, i == 2);
        }
    };
    expect(penetrations);
    expect(tests);
}

/// Of any query but times of impact.
TEST_F(WorldListedSquares, AreAskedWhatTableIsAsked) {
    const InstanceHandle a[] = {scene_.handle(0), scene_.handle(2), scene_.handle(2)};
    const InstanceHandle b[] = {scene_.handle(2), scene_.handle(0), scene_.handle(1)};
    PairTable separations(SeparationQuery{.tolerance = 0.01}, of_list);
    ASSERT_TRUE(scene_.world().update(separations, {.a = a, .b = b}).ok());
    ASSERT_EQ(separations.size(), 3U);
    EXPECT_EQ(separations.rows()[0].distance, 1.0);
    EXPECT_EQ(separations.rows()[1].a, scene_.handle(2));
    EXPECT_EQ(separations.rows()[2].distance, 0.0);
    PairTable contacts(ContactQuery{.tolerance = 0.1, .contact_distance = 0.2}, of_list);
    ASSERT_TRUE(scene_.world().update(contacts, {.a = a, .b = b}).ok());
    EXPECT_EQ(contacts.rows()[0].count, 0U);
    EXPECT_GT(contacts.points(contacts.rows()[2]).size(), 0U);
    EXPECT_GT(contacts.manifold(contacts.rows()[2]).size(), 0U);
    PairTable impacts(TimeOfImpactQuery{.tolerance = 0.1}, of_list);
    EXPECT_EQ(scene_.world().update(impacts, {.a = a, .b = b}).message(),
              "update: times of impact are not asked of a list of pairs");
}

TEST_F(WorldListedSquares, AskTheCpu) {
    const InstanceHandle both[] = {scene_.handle(0), scene_.handle(1)};
    const auto refused = [&](const PenetrationQuery& query, PairTableOptions options) {
        PairTable table(query, options);
        const Status status = scene_.world().update(table, {.a = both, .b = both});
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_TRUE(table.rows().empty());
        return status.message();
    };
    PenetrationQuery query;
    EXPECT_EQ(refused(query, of_list).find("update: the tolerance is 0"), 0U);
    query.tolerance = 0.1;
    EXPECT_EQ(refused(query, {.technique = Technique::cpu}),
              "update: pairs are given to a table that finds its own");
    query.technique = Technique::compute;
    EXPECT_EQ(refused(query, of_list),
              "update: the table is answered by Technique::cpu, and its query asks for "
              "Technique::compute");
    query.technique = Technique::cpu;
    query.on_device = true;
    EXPECT_EQ(refused(query, of_list).find("update: commands of the host, poses that they write"),
              0U);
}

TEST_F(WorldListedSquares, NeedAsManyOfEach) {
    const InstanceHandle both[] = {scene_.handle(0), scene_.handle(1)};
    const InstanceHandle one[] = {scene_.handle(0)};
    PairTable tests(IntersectionTestQuery{}, of_list);
    const Status status = scene_.world().update(tests, {.a = both, .b = one});
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_EQ(status.message(), "update: 2 and 1 instances form no pairs");
}

}  // namespace
}  // namespace nearfield::test
