#include "simulation.hpp"

#include <nearfield/world.hpp>

#include <gtest/gtest.h>
#include <tools/common/library.hpp>
#include <tools/simulation/clearance_scenes.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using namespace simulation;

/// A world of another context with the obstacles of a scene, without the one that moves; and the
/// shape that moves.
class FreshWorld {
public:
    explicit FreshWorld(const ClearanceScene& scene)
        : context_(tools::take(Context::create_cpu())),
          world_(tools::take(nearfield::World::create(context_))),
          query_(scene.query()) {
        for (std::size_t i = 0; i < scene.obstacles().size(); ++i) {
            if (scene.moving_obstacle() != i) {
                WorldInstance instance;
                instance.shape = tools::take(context_.add_shape(scene.obstacles()[i].rings));
                instance.pose = scene.obstacles()[i].pose;
                instance.user = i;
                static_cast<void>(tools::take(world_.add(instance)));
            }
        }
        query_.shape = tools::take(context_.add_shape(scene.mover()));
    }

    [[nodiscard]] Clearance clearance(const Pose& pose) {
        Clearance clearance;
        tools::require(
            world_.find_clearances(query_, std::span(&pose, 1), std::span(&clearance, 1)));
        return clearance;
    }
    [[nodiscard]] std::optional<std::size_t> obstacle(const Clearance& clearance) const {
        return clearance.instance == InstanceHandle{}
                   ? std::nullopt
                   : std::optional<std::size_t>(
                         tools::take(world_.instance(clearance.instance)).user);
    }

private:
    Context context_;
    nearfield::World world_;
    ClearanceQuery query_;
};

void expect_same(const Vector2& a, const Vector2& b) {
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
}

/// Compares every so manieth answer of the last frame with that of a query of its own.
void expect_answers_of_one_query_each(const ClearanceScene& scene, std::size_t step) {
    FreshWorld world(scene);
    ASSERT_EQ(scene.poses().size(), scene.clearances().size());
    for (std::size_t i = 0; i < scene.poses().size(); i += step) {
        const Clearance alone = world.clearance(scene.poses()[i]);
        const Clearance& together = scene.clearances()[i];
        EXPECT_EQ(alone.distance, together.distance) << i;
        EXPECT_EQ(alone.error_bound, together.error_bound) << i;
        expect_same(alone.point, together.point);
        expect_same(alone.nearest, together.nearest);
        expect_same(alone.direction, together.direction);
    }
    const Clearance best =
        world.clearance(scene.path(scene.frame().best_path)[static_cast<std::size_t>(
            &scene.clearance(scene.frame().best_path) -
            &scene.clearances()[scene.frame().best_path * scene.path(0).size()])]);
    EXPECT_EQ(best.distance, scene.frame().clearance.distance);
    EXPECT_EQ(world.obstacle(best), scene.frame().neighbor);
}

/// Counts anew what the frame says about its paths.
void expect_counts_of_paths(const ClearanceScene& scene) {
    const ClearanceFrame& frame = scene.frame();
    const std::size_t length = scene.path(0).size();
    ASSERT_EQ(frame.poses, scene.poses().size());
    ASSERT_EQ(frame.paths * length, frame.poses);
    std::size_t free = 0;
    for (std::size_t path = 0; path < frame.paths; ++path) {
        double least = scene.query().max_clearance;
        for (std::size_t i = 0; i < length; ++i) {
            least = std::min(least, scene.clearances()[path * length + i].distance);
        }
        EXPECT_EQ(scene.clearance(path).distance, least) << path;
        free += least > 0.0 ? 1U : 0U;
    }
    EXPECT_EQ(frame.free_paths, free);
    EXPECT_EQ(frame.clearance.distance, scene.clearance(frame.best_path).distance);
}

class ClearanceScenes : public testing::TestWithParam<NamedClearanceScene> {
protected:
    [[nodiscard]] static std::unique_ptr<ClearanceScene> make() {
        return GetParam().make(simulation_context());
    }
};

TEST_P(ClearanceScenes, AnswerAFrameAsOneQueryEach) {
    const std::unique_ptr<ClearanceScene> scene = make();
    const std::size_t step = scene->poses().size() / 400 + 1;
    for (int round = 0; round < 3; ++round) {
        SCOPED_TRACE("at " + std::to_string(scene->frame().time));
        expect_answers_of_one_query_each(*scene, step);
        expect_counts_of_paths(*scene);
        for (int frame = 0; frame < 2; ++frame) {
            scene->advance();
        }
    }
}

TEST_P(ClearanceScenes, AreTheSameEveryTime) {
    const std::unique_ptr<ClearanceScene> first = make();
    const std::unique_ptr<ClearanceScene> second = make();
    const Pose start = first->pose();
    for (int frame = 0; frame < 3; ++frame) {
        first->advance();
        second->advance();
        expect_same(first->pose().translation, second->pose().translation);
        EXPECT_EQ(first->pose().angle, second->pose().angle);
        EXPECT_EQ(first->frame().clearance.distance, second->frame().clearance.distance);
        EXPECT_EQ(first->frame().best_path, second->frame().best_path);
        EXPECT_EQ(first->frame().free_paths, second->frame().free_paths);
    }
    EXPECT_NE(first->pose().translation.x, start.translation.x);
}

TEST_P(ClearanceScenes, LeaveNoShapesInTheContext) {
    Context context = tools::take(Context::create_cpu());
    std::unique_ptr<ClearanceScene> scene = GetParam().make(context);
    const Obstacle first = scene->obstacles().front();
    EXPECT_TRUE(context.update_shape(first.shape, first.rings).ok());
    const ShapeHandle mover = scene->query().shape;
    scene.reset();
    for (const ShapeHandle& shape : {first.shape, mover}) {
        EXPECT_EQ(context.update_shape(shape, first.rings).code(), StatusCode::unknown_shape);
    }
}

INSTANTIATE_TEST_SUITE_P(All, ClearanceScenes,
                         testing::ValuesIn(clearance_scenes().begin(), clearance_scenes().end()),
                         [](const auto& scene) { return std::string(scene.param.name); });

TEST(Nest, KeepsAGapBetweenItemsAndLeavesTheRestFree) {
    Nest nest(simulation_context());
    ASSERT_TRUE(nest.moving_obstacle());
    ClearanceQuery query;
    for (std::size_t i = 1; i < nest.obstacles().size(); ++i) {
        if (nest.moving_obstacle() == i) {
            continue;
        }
        query.shape = nest.obstacles()[i].shape;
        const Pose pose = nest.obstacles()[i].pose;
        Clearance clearance;
        // The dragged item may lie over others: it does not count.
        tools::require(nest.world().set_filter(nest.obstacles()[*nest.moving_obstacle()].instance,
                                               2U, UINT32_MAX));
        const WorldFilter filter{.mask = 1U, .ignored = nest.obstacles()[i].instance};
        tools::require(nest.world().find_clearances(query, std::span(&pose, 1),
                                                    std::span(&clearance, 1), {.filter = filter}));
        EXPECT_GE(clearance.distance, 0.1 - clearance.error_bound) << i;
    }
}

TEST(Nest, AnItemFollowsTheMouseAndStaysWhereItIsLeft) {
    Nest nest(simulation_context());
    nest.ask();
    const std::size_t wanderer = *nest.moving_obstacle();
    const std::size_t item = nest.obstacles().size() - 1;  // a star about its position
    ASSERT_NE(wanderer, item);
    const Pose start = nest.obstacles()[item].pose;
    const Vector2 hold = start.translation + Vector2{0.1, 0.05};
    nest.grab(hold);
    ASSERT_EQ(nest.moving_obstacle(), item);
    nest.drag(hold + Vector2{1.5, -0.25});
    nest.advance();
    EXPECT_NEAR(nest.pose().translation.x, start.translation.x + 1.5, 1e-12);
    EXPECT_NEAR(nest.pose().translation.y, start.translation.y - 0.25, 1e-12);
    EXPECT_EQ(nest.pose().angle, start.angle);
    expect_answers_of_one_query_each(nest, 1);
    nest.release();
    const Pose left = nest.pose();
    nest.drag({0.0, 0.0});
    nest.advance();
    expect_same(nest.pose().translation, left.translation);
    EXPECT_EQ(nest.moving_obstacle(), item);

    // Another star, dragged there, meets it.
    const Vector2 other = nest.obstacles()[item - 1].pose.translation;
    nest.grab(other);
    ASSERT_EQ(nest.moving_obstacle(), item - 1);
    nest.drag(left.translation + Vector2{0.3, 0.1});
    nest.ask();
    EXPECT_LT(nest.frame().clearance.distance, 0.0);
    expect_answers_of_one_query_each(nest, 1);
}

TEST(Nest, NothingBesideTheItemsCanBeDragged) {
    Nest nest(simulation_context());
    nest.ask();
    const std::size_t wanderer = *nest.moving_obstacle();
    for (const Vector2& point : {Vector2{-0.15, 2.0}, Vector2{-5.0, 2.0}}) {
        nest.grab(point);
        nest.drag({3.0, 3.0});
        nest.advance();
        EXPECT_EQ(nest.moving_obstacle(), wanderer);
    }
    expect_same(nest.obstacles().front().pose.translation, {});
}

TEST(Robots, KeepClearOfTheIslandsOnTheWayToTheGoal) {
    Robots robots(simulation_context());
    robots.ask();
    const double distance = length(*robots.goal() - robots.pose().translation);
    for (int frame = 0; frame < 12; ++frame) {
        robots.advance();
        ASSERT_GT(robots.frame().clearance.distance, 0.0) << frame;
        // The first pose of a path is the present one.
        EXPECT_GT(robots.clearances().front().distance, 0.0) << frame;
    }
    EXPECT_LT(length(*robots.goal() - robots.pose().translation), distance);
}

TEST(Robots, TheGoalAndTheRobotCanBeDragged) {
    Robots robots(simulation_context());
    robots.ask();
    const Vector2 goal = *robots.goal();
    robots.grab(goal);
    robots.drag({5.0, 1.0});
    expect_same(*robots.goal(), {5.0, 1.0});
    robots.release();
    robots.drag(goal);
    expect_same(*robots.goal(), {5.0, 1.0});

    // Onto land, where every path begins with an overlap: it only turns.
    const Pose island = robots.obstacles().front().pose;
    robots.grab(robots.pose().translation);
    robots.drag(island.translation);
    robots.release();
    robots.ask();
    EXPECT_EQ(robots.frame().free_paths, 0U);
    const double angle = robots.pose().angle;
    robots.advance();
    expect_same(robots.pose().translation, island.translation);
    EXPECT_GT(robots.pose().angle, angle);
}

}  // namespace
}  // namespace nearfield::test
