// Hits of all pairs that the device finds: the same results as those of a batch.

#include <gtest/gtest.h>
#include <tests/unit/common/device_scene_test.hpp>
#include <tools/io/query_json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

/// What stays the same whoever finds a hit.
struct Found {
    std::string a;
    std::string b;
    std::size_t count = 0;
    double length = 0.0;  ///< depth or distance
    bool intersects = false;
    double error_bound = 0.0;
    double tolerance = 0.0;
    double cell = 0.0;
    std::vector<Vector2> records;  ///< their points
    std::size_t clusters = 0;
};

Found found_in(const SceneAnswer& answer) {
    const ResultSummary& summary = summary_of(answer.result);
    Found found;
    found.a = answer.a;
    found.b = answer.b;
    found.intersects = summary.intersects;
    found.error_bound = summary.error_bound;
    found.tolerance = summary.tolerance;
    found.cell = summary.cell;
    std::visit(
        [&found](const auto& result) {
            if constexpr (requires { result.count; }) {
                found.count = result.count;
            }
            if constexpr (requires { result.deepest; }) {
                found.length = result.deepest.depth;
            }
            if constexpr (requires { result.distance; }) {
                found.length = result.distance;
            }
            if constexpr (requires { result.points; }) {
                for (const auto& record : result.points) {
                    if constexpr (requires { record.position; }) {
                        found.records.push_back(record.position);
                    }
                }
            }
            if constexpr (requires { result.manifold; }) {
                found.clusters = result.manifold.size();
            }
        },
        answer.result);
    return found;
}

class DevicePairScenes : public DeviceSceneTest {
protected:
    static constexpr double tolerance = 0.02;

    static SceneQuery hits_of(QueryType type) {
        SceneQuery query;
        query.request.type = type;
        query.request.tolerance = type == QueryType::intersection_test ? 0.0 : tolerance;
        query.all_pairs = true;
        query.hits_only = true;
        query.kind = name_of(type);
        return query;
    }

    std::vector<Found> found_by(Scene& scene, Technique technique, FrameInput input) {
        set_technique(scene, technique);
        SceneRunner runner(scene, "scene", context());
        static_cast<void>(runner.run_frame(FrameInput::all));
        static_cast<void>(runner.run_frame(input));
        runner.require_results();
        EXPECT_TRUE(runner.answers().empty() || runner.technique() == to_string(technique));
        EXPECT_GE(runner.pair_count(), runner.answers().size());
        std::vector<Found> all;
        for (const SceneAnswer& answer : runner.answers()) {
            EXPECT_EQ(summary_of(answer.result).technique, technique);
            all.push_back(found_in(answer));
        }
        return all;
    }

    /// Compares with the CPU, which finds the pairs of a batch. Returns the number of hits.
    std::size_t compare(const SceneQuery& query, Scene scene, FrameInput input = FrameInput::all) {
        scene.queries.push_back(query);
        EXPECT_FALSE(is_for_device_pairs(query)) << "automatic";
        const std::vector<Found> expected = found_by(scene, Technique::cpu, input);
        const std::vector<Found> found = found_by(scene, Technique::compute, input);
        EXPECT_TRUE(is_for_device_pairs(scene.queries.front()));
        EXPECT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
            SCOPED_TRACE(expected[i].a + " " + expected[i].b);
            EXPECT_EQ(found[i].a, expected[i].a);
            EXPECT_EQ(found[i].b, expected[i].b);
            EXPECT_EQ(found[i].count, expected[i].count);
            EXPECT_NEAR(found[i].length, expected[i].length, 1e-3 * tolerance);
            EXPECT_EQ(found[i].intersects, expected[i].intersects);
            EXPECT_EQ(found[i].error_bound, expected[i].error_bound);
            EXPECT_EQ(found[i].tolerance, expected[i].tolerance);
            EXPECT_EQ(found[i].cell, expected[i].cell);
            EXPECT_EQ(found[i].records, expected[i].records);
            EXPECT_EQ(found[i].clusters, expected[i].clusters);
        }
        return found.size();
    }
};

constexpr QueryType types[] = {QueryType::penetration, QueryType::contacts,
                               QueryType::intersection_test, QueryType::separation,
                               QueryType::closest_point};

TEST_F(DevicePairScenes, HitsOfAllPairsAreThoseOfABatch) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const Scene scene = random_scene(random, 60);
        for (const QueryType type : types) {
            SCOPED_TRACE(std::string(name_of(type)));
            SceneQuery query = hits_of(type);
            EXPECT_GT(compare(query, scene), 40U);
            query.request.records = false;
            query.request.points = PenetrationPoints::vertices;
            query.reach = 0.5;
            EXPECT_GT(compare(query, scene, FrameInput::poses), 40U);
        }
    }
}

TEST_F(DevicePairScenes, HitsBetweenGroupsAreThoseOfABatch) {
    Random random(50);
    const Scene scene = random_scene(random, 60);
    InstanceGroup low{"low", {}};
    InstanceGroup middle{"middle", {}};
    for (std::size_t i = 0; i < 40; ++i) {
        low.instances.push_back(i);
        middle.instances.push_back(i + 15);
    }
    for (const QueryType type : types) {
        SCOPED_TRACE(std::string(name_of(type)));
        for (const auto& [first, second] :
             {std::pair{low, middle}, std::pair{middle, low}, std::pair{low, low}}) {
            SceneQuery query = hits_of(type);
            query.between = GroupPair{first, second};
            EXPECT_GT(compare(query, scene), 10U);
        }
    }
}

TEST_F(DevicePairScenes, FewInstancesHaveNoHits) {
    Random random(60);
    EXPECT_EQ(compare(hits_of(QueryType::penetration), random_scene(random, 1)), 0U);
    Scene empty = random_scene(random, 1);
    empty.instances.clear();
    EXPECT_EQ(compare(hits_of(QueryType::intersection_test), empty), 0U);
}

TEST_F(DevicePairScenes, WhatTheDeviceHasNoTableOfIsABatch) {
    SceneQuery query = hits_of(QueryType::contacts);
    query.request.technique = Technique::compute;
    EXPECT_TRUE(is_for_device_pairs(query));
    query.request.normals = ContactNormals::gradient;
    EXPECT_FALSE(is_for_device_pairs(query));
    query = hits_of(QueryType::separation);
    query.request.technique = Technique::compute;
    EXPECT_TRUE(is_for_device_pairs(query));
    query.request.tolerance = 0.0;
    EXPECT_FALSE(is_for_device_pairs(query));
    query = hits_of(QueryType::penetration);
    query.request.technique = Technique::compute;
    query.hits_only = false;
    EXPECT_FALSE(is_for_device_pairs(query));
    EXPECT_FALSE(is_for_device_pairs(hits_of(QueryType::containment)));
}

}  // namespace
}  // namespace nearfield::tools
