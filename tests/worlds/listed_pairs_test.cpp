// Pairs of the caller's own list: against a batch, bit for bit, and where they differ from other
// queries of a world.

#include "scene.hpp"

#include <gtest/gtest.h>

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
        for (int pair = 0; pair < 300; ++pair) {
            const std::size_t i = any();
            const std::size_t j = any();
            a.push_back(scene.handle(i));
            b.push_back(scene.handle(j));
            batch.add(IntersectionTestQuery{scene.instance(i), scene.instance(j)});
        }
        std::vector<std::uint8_t> intersects(a.size(), 7);
        ASSERT_TRUE(scene.world().test_pairs(a, b, intersects).ok());
        Results results;
        ASSERT_TRUE(scene.context().run(batch, results).ok());
        for (std::size_t i = 0; i < a.size(); ++i) {
            const auto& test = std::get<IntersectionTestResult>(results.results[i]);
            EXPECT_TRUE(test.status.ok()) << test.status.text();
            EXPECT_EQ(intersects[i], test.intersects ? 1 : 0) << "pair " << i;
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
    std::vector<PairRow<PenetrationQuery>> rows(a.size());
    rows[0].count = 17;
    const Status status = scene.world().find_penetrations(asked, a, b, rows);
    ASSERT_TRUE(status.ok()) << status.text();
    Results results;
    ASSERT_TRUE(scene.context().run(batch, results).ok());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        SCOPED_TRACE("pair " + std::to_string(i));
        const auto& result = std::get<PenetrationResult>(results.results[i]);
        const PairRow<PenetrationQuery>& row = rows[i];
        EXPECT_EQ(row.a, a[i]);
        EXPECT_EQ(row.b, b[i]);
        EXPECT_EQ(row.record_count, 0U);
        EXPECT_EQ(row.status, result.status.code()) << result.status.text();
        if (row.status != StatusCode::ok) {
            continue;
        }
        EXPECT_EQ(row.intersects, result.intersects);
        EXPECT_EQ(row.error_bound, result.error_bound);
        EXPECT_EQ(row.count, result.count);
        EXPECT_EQ(row.deepest.depth, result.deepest.depth);
        EXPECT_EQ(row.deepest.point.x, result.deepest.point.x);
        EXPECT_EQ(row.deepest.point.y, result.deepest.point.y);
        EXPECT_EQ(row.deepest.nearest.x, result.deepest.nearest.x);
        EXPECT_EQ(row.deepest.nearest.y, result.deepest.nearest.y);
        EXPECT_EQ(row.deepest.direction.x, result.deepest.direction.x);
        EXPECT_EQ(row.deepest.direction.y, result.deepest.direction.y);
        EXPECT_EQ(row.deepest.feature.kind, result.deepest.feature.kind);
        EXPECT_EQ(row.deepest.feature.index, result.deepest.feature.index);
        EXPECT_EQ(row.deepest.unique, result.deepest.unique);
    }
}

TEST_P(WorldListedPairs, PenetrateAsInABatch) {
    const auto kind = static_cast<SceneKind>(GetParam());
    const int begin = first_world_case();
    for (int number = begin; number < begin + world_cases(6); ++number) {
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
        for (int pair = 0; pair < 300; ++pair) {
            a.push_back(any());
            b.push_back(any());
            if (random.whole(0, 2) == 0) {
                a.push_back(b.back());
                b.push_back(a[a.size() - 2]);
            }
        }
        PenetrationQuery query;
        query.tolerance = 0.05;
        query.points = PenetrationPoints::vertices;
        expect_rows_of_batch(scene, Listed(scene), query, a, b);
        query.points = PenetrationPoints::boundary;
        // Of the largest shapes, as few samples as there is memory for.
        query.tolerance = kind == SceneKind::extreme ? 1e6 : 0.05;
        expect_rows_of_batch(scene, Listed(scene), query, a, b);
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
        std::vector<std::uint8_t> intersects(a.size(), 7);
        const Status status = scene_.world().test_pairs(a, b, intersects);
        EXPECT_TRUE(status.ok()) << status.text();
        return {intersects.begin(), intersects.end()};
    }

    Scene scene_{{{"left", rectangle({0, 0}, {1, 1}), {}, 1, 1},
                  {"middle", rectangle({0, 0}, {1, 1}), {{1.0, 0.0}}, 2, 2},
                  {"right", rectangle({0, 0}, {1, 1}), {{2.0, 0.0}}, 4, 4}}};
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
    std::vector<PairRow<PenetrationQuery>> rows(3);
    PenetrationQuery query;
    query.tolerance = 0.1;
    for (const PenetrationPoints points :
         {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
        query.points = points;
        ASSERT_TRUE(scene_.world().find_penetrations(query, a, b, rows).ok());
        EXPECT_EQ(rows[0].status, StatusCode::unknown_shape);
        EXPECT_EQ(rows[1].status, StatusCode::unknown_shape);
        EXPECT_EQ(rows[2].status, StatusCode::ok);
        EXPECT_TRUE(rows[2].intersects);
    }
}

TEST_F(WorldListedSquares, AskTheCpu) {
    const InstanceHandle both[] = {scene_.handle(0), scene_.handle(1)};
    std::vector<PairRow<PenetrationQuery>> rows(2);
    const auto refused = [&](const PenetrationQuery& query) {
        const Status status = scene_.world().find_penetrations(query, both, both, rows);
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        return status.message();
    };
    PenetrationQuery query;
    EXPECT_EQ(refused(query).find("find_penetrations: the tolerance is 0"), 0U) << refused(query);
    query.tolerance = 0.1;
    query.technique = Technique::compute;
    EXPECT_EQ(refused(query),
              "find_penetrations: pairs of a world are answered by Technique::cpu; the query asks "
              "for another technique, or for resident results");
    query.technique = Technique::cpu;
    query.resident = true;
    EXPECT_EQ(refused(query).find("find_penetrations: pairs of a world"), 0U) << refused(query);
    query.resident = false;
    const Status status =
        scene_.world().find_penetrations(query, both, both, std::span(rows).first(1));
    EXPECT_EQ(status.message(),
              "find_penetrations: 2 and 2 instances form no pairs with space for 1 answers");
}

TEST_F(WorldListedSquares, NeedAsManyOfEach) {
    const InstanceHandle both[] = {scene_.handle(0), scene_.handle(1)};
    const InstanceHandle one[] = {scene_.handle(0)};
    std::vector<std::uint8_t> intersects(2);
    const Status of_second = scene_.world().test_pairs(both, one, intersects);
    EXPECT_EQ(of_second.code(), StatusCode::invalid_query);
    EXPECT_EQ(of_second.message(),
              "test_pairs: 2 and 1 instances form no pairs with space for 2 answers");
    const Status of_first = scene_.world().test_pairs(one, both, intersects);
    EXPECT_EQ(of_first.message(),
              "test_pairs: 1 and 2 instances form no pairs with space for 2 answers");
}

}  // namespace
}  // namespace nearfield::test
