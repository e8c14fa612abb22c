// Pairs of the caller's own list: against a batch, bit for bit, and where they differ from other
// queries of a world.

#include "scene.hpp"

#include <gtest/gtest.h>
#include <tests/support/pair_tables.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

class WorldListedPairs : public testing::TestWithParam<int> {};

TEST_P(WorldListedPairs, AreThoseOfABatch) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int first = first_world_case();
    for (int number = first; number < first + world_cases(6); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 83U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        Random random(seed + 1);
        const auto any = [&] {
            return static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.size()) - 1));
        };
        // In any order, some twice, some with itself.
        std::vector<InstanceHandle> a;
        std::vector<InstanceHandle> b;
        Batch batch;
        for (int pair = 0; pair < 150; ++pair) {
            const std::size_t i = any();
            const std::size_t j = any();
            a.push_back(scene.handle(i));
            b.push_back(scene.handle(j));
            batch.add(IntersectionTestQuery{scene.instance(i), scene.instance(j)});
        }
        PairTable table(IntersectionTestQuery{}, of_list);
        ASSERT_TRUE(scene.world().update(table, {.a = a, .b = b}).ok());
        ASSERT_EQ(table.rows().size(), a.size());
        EXPECT_EQ(table.candidates(), a.size());
        Results results;
        ASSERT_TRUE(scene.context().run(batch, results).ok());
        for (std::size_t i = 0; i < a.size(); ++i) {
            const auto& test = std::get<IntersectionTestResult>(results.results[i]);
            EXPECT_TRUE(test.status.ok()) << test.status.text();
            const PairRow<IntersectionTestQuery>& row = table.rows()[i];
            EXPECT_EQ(row.a, a[i]);
            EXPECT_EQ(row.b, b[i]);
            EXPECT_EQ(row.index, i);
            EXPECT_EQ(row.intersects, test.intersects) << "pair " << i;
            EXPECT_EQ(row.error_bound, test.error_bound) << "pair " << i;
        }
    }
}

/// Pairs by instances of a scene and others, which are in its world too.
struct Listed {
    std::vector<Instance> instances;
    std::vector<InstanceHandle> handles;

    explicit Listed(const Scene& scene) {
        for (std::size_t i = 0; i < scene.size(); ++i) {
            instances.push_back(scene.instance(i));
            handles.push_back(scene.handle(i));
        }
    }
    void add(Scene& scene, const Instance& instance) {
        instances.push_back(instance);
        handles.push_back(*scene.world().add({instance.shape, instance.pose}));
    }
};

/// The rows of a list, against the results of a batch of the same queries.
void expect_rows_of_batch(Scene& scene, const Listed& listed, const PenetrationQuery& asked,
                          const std::vector<std::size_t>& first,
                          const std::vector<std::size_t>& second) {
    std::vector<InstanceHandle> a;
    std::vector<InstanceHandle> b;
    Batch batch;
    PenetrationQuery query = asked;
    query.technique = Technique::cpu;
    for (std::size_t i = 0; i < first.size(); ++i) {
        a.push_back(listed.handles[first[i]]);
        b.push_back(listed.handles[second[i]]);
        query.a = listed.instances[first[i]];
        query.b = listed.instances[second[i]];
        batch.add(query);
    }
    PairTable table(asked, of_list);
    const Status status = scene.world().update(table, {.a = a, .b = b});
    ASSERT_TRUE(status.ok()) << status.text();
    const auto rows = table.rows();
    ASSERT_EQ(rows.size(), a.size());
    Results results;
    ASSERT_TRUE(scene.context().run(batch, results).ok());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        SCOPED_TRACE("pair " + std::to_string(i));
        const auto& result = std::get<PenetrationResult>(results.results[i]);
        const PairRow<PenetrationQuery>& row = rows[i];
        EXPECT_EQ(row.a, a[i]);
        EXPECT_EQ(row.b, b[i]);
        EXPECT_EQ(row.point_count, result.points.size());
        EXPECT_EQ(row.status, result.status.code()) << result.status.text();
        if (row.status != StatusCode::ok) {
            continue;
        }
        EXPECT_EQ(row.intersects, result.intersects);
        EXPECT_EQ(row.error_bound, result.error_bound);
        EXPECT_EQ(row.count, result.count);
        EXPECT_EQ(row.deepest.depth, result.deepest.depth);
        EXPECT_EQ(row.deepest.position.x, result.deepest.position.x);
        EXPECT_EQ(row.deepest.position.y, result.deepest.position.y);
        EXPECT_EQ(row.deepest.nearest.x, result.deepest.nearest.x);
        EXPECT_EQ(row.deepest.nearest.y, result.deepest.nearest.y);
        EXPECT_EQ(row.deepest.direction.x, result.deepest.direction.x);
        EXPECT_EQ(row.deepest.direction.y, result.deepest.direction.y);
        EXPECT_EQ(row.deepest.feature.kind, result.deepest.feature.kind);
        EXPECT_EQ(row.deepest.feature.index, result.deepest.feature.index);
        EXPECT_EQ(row.deepest.unique, result.deepest.unique);
        const auto records = table.points(row);
        ASSERT_EQ(records.size(), result.points.size());
        for (std::size_t k = 0; k < records.size(); ++k) {
            EXPECT_EQ(records[k].position, result.points[k].position);
            EXPECT_EQ(records[k].depth, result.points[k].depth);
        }
    }
    PairTable hits(asked, {.hits_only = true, .listed = true});
    ASSERT_TRUE(scene.world().update(hits, {.a = a, .b = b}).ok());
    std::size_t next = 0;
    for (const PairRow<PenetrationQuery>& row : rows) {
        if (row.count > 0 || row.status != StatusCode::ok) {
            ASSERT_LT(next, hits.rows().size());
            const PairRow<PenetrationQuery>& hit = hits.rows()[next];
            EXPECT_EQ(hit.a, row.a);
            EXPECT_EQ(hit.b, row.b);
            EXPECT_EQ(hit.index, next);
            EXPECT_EQ(hits.points(hit).size(), table.points(row).size());
            ++next;
        }
    }
    EXPECT_EQ(next, hits.rows().size());
}

TEST_P(WorldListedPairs, PenetrateAsInABatch) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int begin = first_world_case();
    for (int number = begin; number < begin + world_cases(3); ++number) {
        const std::uint64_t seed = 1000U * static_cast<std::uint64_t>(number) + 89U;
        SCOPED_TRACE(std::string(to_string(kind)) + ", seed " + std::to_string(seed));
        Scene scene(make_scene(kind, seed));
        Random random(seed + 1);
        const auto any = [&] {
            return static_cast<std::size_t>(random.whole(0, static_cast<int>(scene.size()) - 1));
        };
        std::vector<std::size_t> a;
        std::vector<std::size_t> b;
        // In any order; some with itself, and some in both directions, one after the other.
        for (int pair = 0; pair < 150; ++pair) {
            a.push_back(any());
            b.push_back(any());
            if (random.whole(0, 2) == 0) {
                a.push_back(b.back());
                b.push_back(a[a.size() - 2]);
            }
        }
        PenetrationQuery query;
        for (const bool records : {false, true}) {
            query.summary_only = !records;
            query.tolerance = 0.05;
            query.points = PenetrationPoints::vertices;
            expect_rows_of_batch(scene, Listed(scene), query, a, b);
            query.points = PenetrationPoints::boundary;
            // Of the largest shapes, as few samples as there is memory for.
            query.tolerance = kind == SceneKind::extreme ? 1e6 : 0.05;
            expect_rows_of_batch(scene, Listed(scene), query, a, b);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldListedPairs, testing::Range(0, scene_kinds));

/// Three squares, each of which touches the next.
class WorldListedSquares : public testing::Test {
protected:
    [[nodiscard]] std::vector<int> test(const std::vector<std::size_t>& first,
                                        const std::vector<std::size_t>& second) {
        std::vector<InstanceHandle> a;
        std::vector<InstanceHandle> b;
        for (std::size_t i = 0; i < first.size(); ++i) {
            a.push_back(scene_.handle(first[i]));
            b.push_back(scene_.handle(second[i]));
        }
        const Status status = scene_.world().update(tests_, {.a = a, .b = b});
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(tests_.rows().size(), a.size());
        std::vector<int> intersects;
        for (const PairRow<IntersectionTestQuery>& row : tests_.rows()) {
            intersects.push_back(row.intersects ? 1 : 0);
        }
        return intersects;
    }

    Scene scene_{{{"left", rectangle({0, 0}, {1, 1}), {}, 1, 1},
                  {"middle", rectangle({0, 0}, {1, 1}), {{1.0, 0.0}}, 2, 2},
                  {"right", rectangle({0, 0}, {1, 1}), {{2.0, 0.0}}, 4, 4}}};
    PairTable<IntersectionTestQuery> tests_{IntersectionTestQuery{}, of_list};
};

TEST_F(WorldListedSquares, IgnoreFiltersAndFollowMoves) {
    EXPECT_EQ(test({0, 1, 0, 2, 1}, {1, 2, 2, 1, 1}), (std::vector<int>{1, 1, 0, 1, 1}));
    ASSERT_TRUE(scene_.world().move(scene_.handle(2), {{0.5, 0.5}}).ok());
    EXPECT_EQ(test({0, 1, 0}, {1, 2, 2}), (std::vector<int>{1, 1, 1}));
    ASSERT_TRUE(
        scene_.context().update_shape(scene_.shape(1), rectangle({0.1, 0}, {0.2, 0.1})).ok());
    EXPECT_EQ(test({0, 1}, {1, 2}), (std::vector<int>{0, 0}));
}

TEST_F(WorldListedSquares, WithoutTheirShapeMeetNothing) {
    ASSERT_TRUE(scene_.context().remove_shape(scene_.shape(1)).ok());
    EXPECT_EQ(test({0, 1, 1}, {1, 2, 1}), (std::vector<int>{0, 0, 0}));
    EXPECT_EQ(tests_.rows()[1].status, StatusCode::unknown_shape);
}

TEST_F(WorldListedSquares, StateWhatIsWrongWithAPair) {
    Listed listed(scene_);
    const auto rounded = scene_.context().add_shape(rectangle({0, 0}, {1, 1}), 0.02);
    ASSERT_TRUE(rounded.has_value());
    listed.add(scene_, {scene_.shape(0), {{1e6, 0.0}}});
    listed.add(scene_, {*rounded, {{0.5, 0.0}}});
    for (const PenetrationPoints points :
         {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
        PenetrationQuery query;
        query.points = points;
        query.tolerance = 0.03;  // finer than the rounded one permits
        expect_rows_of_batch(scene_, listed, query, {0, 4, 0, 3}, {4, 1, 1, 0});
        query.tolerance = 8e-7;  // too fine for the far one
        expect_rows_of_batch(scene_, listed, query, {0, 3, 1, 0}, {3, 3, 1, 1});
        query.tolerance = 0.1;
        expect_rows_of_batch(scene_, listed, query, {0, 1, 2}, {1, 2, 0});
    }
    ASSERT_TRUE(scene_.context().remove_shape(scene_.shape(1)).ok());
    const InstanceHandle a[] = {scene_.handle(0), scene_.handle(1), scene_.handle(2)};
    const InstanceHandle b[] = {scene_.handle(1), scene_.handle(2), scene_.handle(2)};
    PenetrationQuery query{.tolerance = 0.1, .summary_only = true};
    for (const PenetrationPoints points :
         {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
        query.points = points;
        PairTable table(query, of_list);
        ASSERT_TRUE(scene_.world().update(table, {.a = a, .b = b}).ok());
        const auto rows = table.rows();
        EXPECT_EQ(rows[0].status, StatusCode::unknown_shape);
        EXPECT_EQ(rows[1].status, StatusCode::unknown_shape);
        EXPECT_EQ(rows[2].status, StatusCode::ok);
        EXPECT_TRUE(rows[2].intersects);
    }
}

/// The list may be another one at each update, and empty.
TEST_F(WorldListedSquares, AreThoseOfTheLastList) {
    EXPECT_EQ(test({0, 1, 0}, {1, 2, 2}), (std::vector<int>{1, 1, 0}));
    EXPECT_EQ(test({2, 2}, {0, 1}), (std::vector<int>{0, 1}));
    EXPECT_EQ(test({}, {}), std::vector<int>{});
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
    const Status status = scene_.world().update(tests_, {.a = both, .b = one});
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_EQ(status.message(), "update: 2 and 1 instances form no pairs");
}

}  // namespace
}  // namespace nearfield::test
