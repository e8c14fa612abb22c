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
