// Hits of all pairs that the device finds: the same results as those of a batch.

#include <gtest/gtest.h>
#include <tests/unit/common/device_scene_test.hpp>
#include <tools/io/answer.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace nearfield::tools {
namespace {

constexpr double tolerance = 0.02;

/// All that stays the same whoever finds a hit.
void expect_same(const SceneAnswer& found, const SceneAnswer& expected) {
    EXPECT_EQ(found.a, expected.a);
    EXPECT_EQ(found.b, expected.b);
    std::visit(
        [&expected](const auto& one) {
            const auto& other = std::get<std::decay_t<decltype(one)>>(expected.result);
            EXPECT_EQ(one.intersects, other.intersects);
            EXPECT_EQ(one.error_bound, other.error_bound);
            EXPECT_EQ(one.tolerance, other.tolerance);
            EXPECT_EQ(one.cell, other.cell);
            if constexpr (requires { one.count; }) {
                EXPECT_EQ(one.count, other.count);
            }
            if constexpr (requires { one.deepest; }) {
                EXPECT_NEAR(one.deepest.depth, other.deepest.depth, 1e-3 * tolerance);
            }
            if constexpr (requires { one.distance; }) {
                EXPECT_NEAR(one.distance, other.distance, 1e-3 * tolerance);
            }
            if constexpr (requires { one.points.front().position; }) {
                EXPECT_TRUE(std::ranges::equal(
                    one.points, other.points, {}, [](const auto& point) { return point.position; },
                    [](const auto& point) { return point.position; }));
            }
            if constexpr (requires { one.manifold; }) {
                EXPECT_EQ(one.manifold.size(), other.manifold.size());
            }
        },
        found.result);
}

class DevicePairScenes : public DeviceSceneTest {
protected:
    static SceneQuery hits_of(QueryType type) {
        SceneQuery query;
        query.request.type = type;
        query.request.tolerance = type == QueryType::intersection_test ? 0.0 : tolerance;
        query.all_pairs = true;
        query.hits_only = true;
        query.kind = name_of(type);
        return query;
    }

    static std::vector<SceneAnswer> answers_of(SceneRunner& runner, FrameInput input,
                                               Technique technique) {
        static_cast<void>(runner.run_frame(FrameInput::all));
        static_cast<void>(runner.run_frame(input));
        runner.require_results();
        const std::vector<SceneAnswer> answers = runner.answers();
        EXPECT_TRUE(answers.empty() || runner.technique() == to_string(technique));
        EXPECT_GE(runner.pair_count(), answers.size());
        for (const SceneAnswer& answer : answers) {
            EXPECT_EQ(summary_of(answer.result).technique, technique);
        }
        return answers;
    }

    /// Compares with the CPU, which finds the pairs of a batch. Returns the number of hits.
    std::size_t compare(const SceneQuery& query, Scene scene, FrameInput input = FrameInput::all) {
        scene.queries.push_back(query);
        EXPECT_FALSE(is_for_device_pairs(query)) << "automatic";
        Scene of_device = scene;
        set_technique(scene, Technique::cpu);
        set_technique(of_device, Technique::compute);
        EXPECT_TRUE(is_for_device_pairs(of_device.queries.front()));
        SceneRunner reference(scene, "scene", context());
        SceneRunner runner(of_device, "scene", context());
        const std::vector<SceneAnswer> expected = answers_of(reference, input, Technique::cpu);
        const std::vector<SceneAnswer> found = answers_of(runner, input, Technique::compute);
        EXPECT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
            SCOPED_TRACE(std::string(expected[i].a) + " " + std::string(expected[i].b));
            expect_same(found[i], expected[i]);
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
