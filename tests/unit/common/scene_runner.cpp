#include <gtest/gtest.h>
#include <tools/common/scene_runner.hpp>

#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield::tools {
namespace {

/// Two squares, 4 apart.
Scene two_squares() {
    Scene scene;
    scene.shapes.push_back({.name = "square", .rings = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}});
    scene.instances.push_back({.name = "left", .shape = 0, .pose = {}});
    scene.instances.push_back({.name = "right", .shape = 0, .pose = {{5.0, 0.0}}});
    SceneQuery query;
    query.request.type = QueryType::separation;
    query.request.technique = Technique::cpu;
    query.request.tolerance = 0.01;
    query.a = 0;
    query.b = 1;
    scene.queries.push_back(query);
    query.all_pairs = true;
    query.reach = 5.0;
    scene.queries.push_back(query);
    return scene;
}

/// Where each query finds its points.
std::pair<Vector2, Vector2> points_b(const SceneRunner& runner) {
    const std::vector<SceneAnswer> answers = runner.answers();
    EXPECT_EQ(answers.size(), 2U);
    const auto point_of = [](const SceneAnswer& answer) {
        return std::get<SeparationResult>(answer.result).point_b;
    };
    return {point_of(answers.front()), point_of(answers.back())};
}

TEST(SceneRunner, ChangesEveryPoseWhereShapesStay) {
    const Scene scene = two_squares();
    Context context = std::move(*Context::create_cpu());
    SceneRunner runner(scene, "two squares", context);
    static_cast<void>(runner.run_frame(FrameInput::all));
    const auto given = points_b(runner);
    EXPECT_EQ(given.first.x, 5.0);
    EXPECT_EQ(given.second.x, 5.0);
    for (int i = 0; i < 2; ++i) {
        static_cast<void>(runner.run_frame(FrameInput::poses));
        const auto moved = points_b(runner);
        EXPECT_NE(moved.first.x, 5.0) << "the frame has the poses of the one before";
        EXPECT_NE(moved.second.x, 5.0) << "the pairs have the poses of the frame before";
        EXPECT_NEAR(moved.first.x, 5.0, 1e-14);
        EXPECT_NEAR(moved.second.x, 5.0, 1e-14);
        static_cast<void>(runner.run_frame(FrameInput::nothing));
        EXPECT_EQ(points_b(runner), moved);
        static_cast<void>(runner.run_frame(FrameInput::poses));
        EXPECT_EQ(points_b(runner), given);
    }
    static_cast<void>(runner.run_frame(FrameInput::all));
    EXPECT_EQ(points_b(runner), given);
}

TEST(SceneRunner, FindsThePairsOfThePosesThatAFrameHas) {
    // The left square moves by more units in the last place than the right one, towards it. Of
    // some gap between them, which depends on the roundings of boxes, nothing is left then.
    constexpr int gaps = 64;
    int found = 0;
    for (int gap = 0; gap < gaps; ++gap) {
        Scene scene = two_squares();
        scene.queries.front() = scene.queries.back();
        scene.queries.pop_back();
        scene.queries.front().reach = 0.0;
        scene.instances[0].pose.translation.x = -2.0;
        scene.instances[1].pose.translation.x = -1.0 + gap * 0x1p-53;
        Context context = std::move(*Context::create_cpu());
        SceneRunner runner(scene, "two squares", context);
        static_cast<void>(runner.run_frame(FrameInput::all));
        const std::size_t given = runner.pair_count();
        static_cast<void>(runner.run_frame(FrameInput::poses));
        found += runner.pair_count() > given ? 1 : 0;
    }
    EXPECT_GT(found, 0);
    EXPECT_LT(found, gaps);
}

}  // namespace
}  // namespace nearfield::tools
