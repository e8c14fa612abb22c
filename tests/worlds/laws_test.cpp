#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/run_on_threads.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace nearfield::test {
namespace {

using Job = void (*)(void* data, std::uint32_t number);

void run_backwards(void* user, std::uint32_t jobs, Job job, void* data) {
    for (std::uint32_t i = jobs; i-- > 0;) {
        job(data, i);
    }
    ++*static_cast<std::uint32_t*>(user);
}

/// Answers in which an instance is named by its position.
Answers answers_of(Scene& scene, ShapeHandle shape, const Questions& questions) {
    Answers answers([&scene](InstanceHandle handle) {
        const auto position = scene.position(handle);
        return position ? static_cast<double>(*position) : -1.0;
    });
    answers.ask(scene.world(), shape, questions);
    EXPECT_TRUE(answers.status().ok()) << answers.status().text();
    return answers;
}

struct Ask {
    explicit Ask(std::uint64_t seed) : random(seed) {
        placements = make_scene(SceneKind::ordinary, seed);
        item = scaled_and_moved(star(random, 17, 0.4), 0.5, {});
        questions = any_questions(random, box_of(placements), 500);
    }

    Random random;
    std::vector<Placement> placements;
    Rings item;
    Questions questions;
};

TEST(WorldJobs, GiveTheSameAnswersHoweverMany) {
    Ask ask(3);
    Scene alone(ask.placements);
    const Answers expected = answers_of(alone, alone.add_shape(ask.item), ask.questions);
    ASSERT_GT(expected.size(), 10000U);
    for (const std::uint32_t count : {1U, 2U, 3U, 7U}) {
        std::uint32_t calls = 0;
        for (const JobSystem& jobs :
             {JobSystem{nullptr, count, run_on_threads}, JobSystem{&calls, count, run_backwards}}) {
            Settings settings;
            settings.jobs = jobs;
            Scene scene(ask.placements, settings);
            const ShapeHandle item = scene.add_shape(ask.item);
            for (int frame = 0; frame < 2; ++frame) {
                const Answers answers = answers_of(scene, item, ask.questions);
                EXPECT_EQ(answers.difference_from(expected), "") << count << " jobs";
            }
        }
        EXPECT_EQ(calls > 0, count > 1) << "the work is not divided";
    }
}

TEST(WorldJobs, AreAtLeastOneAndAtMostTheirMaximum) {
    for (const std::uint32_t count : {0U, 1U, max_jobs, max_jobs + 1U}) {
        Settings settings;
        settings.jobs = JobSystem{nullptr, count, run_on_threads};
        const Expected<Context> context = Context::create_cpu(settings);
        EXPECT_EQ(context.has_value(), count >= 1 && count <= max_jobs) << count << " jobs";
        if (!context) {
            EXPECT_EQ(context.error().code(), StatusCode::invalid_settings);
            EXPECT_NE(context.error().message().find(std::to_string(count)), std::string::npos);
        }
    }
}

/// What is asked at the same time, and in what order, changes nothing.
TEST(WorldLaws, OneByOneIsTheSameAsTogether) {
    for (int number = 0; number < world_cases(6); ++number) {
        const auto seed = static_cast<std::uint64_t>(number);
        const auto kind = static_cast<SceneKind>(number % scene_kinds);
        Scene scene(make_scene(kind, seed));
        Random random(seed);
        const Rings item = any_shape(random).rings;
        const ShapeHandle shape = scene.add_shape(item);
        const Rectangle box = box_of(scene.placements());
        std::vector<Pose> poses;
        std::vector<Vector2> points;
        for (int i = 0; i < 60; ++i) {
            points.push_back(any_point(random, scene, box));
            poses.push_back({points.back(), random.between(-3.0, 3.0)});
        }
        std::vector<Clearance> together(poses.size());
        ASSERT_TRUE(scene.world().find_clearances({shape}, poses, together).ok());
        std::vector<NearestHit> nearest(points.size());
        std::vector<NearestHit> edges(points.size());
        NearestQuery of_edges;
        of_edges.kind = NearestKind::edges;
        ASSERT_TRUE(scene.world().find_nearest({}, points, nearest).ok());
        ASSERT_TRUE(scene.world().find_nearest(of_edges, points, edges).ok());
        for (std::size_t i = poses.size(); i-- > 0;) {
            SCOPED_TRACE(testing::Message() << to_string(kind) << " " << seed << ", pose " << i);
            Clearance one;
            NearestHit instance;
            NearestHit edge;
            ASSERT_TRUE(scene.world().find_clearances({shape}, {&poses[i], 1}, {&one, 1}).ok());
            ASSERT_TRUE(scene.world().find_nearest({}, {&points[i], 1}, {&instance, 1}).ok());
            ASSERT_TRUE(scene.world().find_nearest(of_edges, {&points[i], 1}, {&edge, 1}).ok());
            EXPECT_EQ(one.distance, together[i].distance);
            EXPECT_EQ(one.instance, together[i].instance);
            EXPECT_EQ(one.point, together[i].point);
            EXPECT_EQ(one.nearest, together[i].nearest);
            EXPECT_EQ(one.direction, together[i].direction);
            for (const auto& [a, b] :
                 {std::pair(instance, nearest[i]), std::pair(edge, edges[i])}) {
                EXPECT_EQ(a.distance, b.distance);
                EXPECT_EQ(a.instance, b.instance);
                EXPECT_EQ(a.nearest, b.nearest);
                EXPECT_EQ(a.feature.kind, b.feature.kind);
                EXPECT_EQ(a.feature.index, b.feature.index);
            }
        }
    }
}

TEST(WorldLaws, WhoeverOwnsTheWorldAndTheContext) {
    Ask ask(11);
    Scene scene(ask.placements);
    const ShapeHandle shape = scene.add_shape(ask.item);
    const Answers expected = answers_of(scene, shape, ask.questions);
    Context context(std::move(scene.context()));
    World world(std::move(scene.world()));
    // Another world of the same context, in which the same shapes are in reverse order.
    World other = std::move(*World::create(context));
    for (std::size_t i = scene.size(); i-- > 0;) {
        ASSERT_TRUE(other.add({scene.shape(i), ask.placements[i].pose}).has_value());
    }
    std::vector<std::uint8_t> intersects(ask.questions.poses.size());
    ASSERT_TRUE(other.test_poses(shape, ask.questions.poses, intersects).ok());
    Answers moved([&scene](InstanceHandle handle) {
        const auto position = scene.position(handle);
        return position ? static_cast<double>(*position) : -1.0;
    });
    moved.ask(world, shape, ask.questions);
    EXPECT_TRUE(moved.status().ok()) << moved.status().text();
    EXPECT_EQ(moved.difference_from(expected), "");
    // Both see a shape that has changed.
    ASSERT_TRUE(context.update_shape(scene.shape(0), rectangle({0, 0}, {90, 90})).ok());
    ask.placements[0].rings = rectangle({0, 0}, {90, 90});
    Scene deformed(ask.placements);
    const Answers later = answers_of(deformed, deformed.add_shape(ask.item), ask.questions);
    Answers moved_later([&scene](InstanceHandle handle) {
        const auto position = scene.position(handle);
        return position ? static_cast<double>(*position) : -1.0;
    });
    ASSERT_TRUE(other.test_poses(shape, ask.questions.poses, intersects).ok());
    moved_later.ask(world, shape, ask.questions);
    EXPECT_EQ(moved_later.difference_from(later), "");
    std::vector<std::uint8_t> expected_intersects(intersects.size());
    World fresh = std::move(*World::create(context));
    for (std::size_t i = 0; i < scene.size(); ++i) {
        ASSERT_TRUE(fresh.add({scene.shape(i), ask.placements[i].pose}).has_value());
    }
    ASSERT_TRUE(fresh.test_poses(shape, ask.questions.poses, expected_intersects).ok());
    EXPECT_EQ(intersects, expected_intersects);
}

/// Numbers do not depend on the order of adding; only who comes first among equals does.
TEST(WorldLaws, TheOrderOfAddingDecidesTiesAlone) {
    for (int number = 0; number < world_cases(6); ++number) {
        Ask ask(static_cast<std::uint64_t>(100 + number));
        Scene forwards(ask.placements);
        std::vector<Placement> reversed(ask.placements.rbegin(), ask.placements.rend());
        Scene backwards(reversed);
        const auto name_backwards = [&](InstanceHandle handle) {
            const auto position = backwards.position(handle);
            return position ? static_cast<double>(backwards.size() - 1 - *position) : -1.0;
        };
        const ShapeHandle a = forwards.add_shape(ask.item);
        const ShapeHandle b = backwards.add_shape(ask.item);
        // There are no ties in this scene, except where a distance is exactly 0.
        const std::vector<Pose>& poses = ask.questions.poses;
        std::vector<Clearance> first(poses.size());
        std::vector<Clearance> second(poses.size());
        ASSERT_TRUE(forwards.world().find_clearances({a}, poses, first).ok());
        ASSERT_TRUE(backwards.world().find_clearances({b}, poses, second).ok());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            EXPECT_EQ(first[i].distance, second[i].distance);
            if (first[i].distance != 0.0) {
                EXPECT_EQ(static_cast<double>(*forwards.position(first[i].instance)),
                          name_backwards(second[i].instance));
                EXPECT_EQ(first[i].point, second[i].point);
            }
        }
        const auto all = static_cast<std::uint32_t>(forwards.size());
        NearestQuery query;
        query.count = all;
        std::vector<NearestHit> hits(all * ask.questions.points.size());
        std::vector<NearestHit> others(hits.size());
        ASSERT_TRUE(forwards.world().find_nearest(query, ask.questions.points, hits).ok());
        ASSERT_TRUE(backwards.world().find_nearest(query, ask.questions.points, others).ok());
        for (std::size_t i = 0; i < hits.size(); ++i) {
            EXPECT_EQ(hits[i].distance, others[i].distance);
            EXPECT_EQ(static_cast<double>(*forwards.position(hits[i].instance)),
                      name_backwards(others[i].instance));
        }
    }
}

/// Everything moved by the same rigid motion: distances stay, up to both bounds.
TEST(WorldLaws, ARigidMotionOfEverythingChangesNothing) {
    for (int number = 0; number < world_cases(8); ++number) {
        Ask ask(static_cast<std::uint64_t>(200 + number));
        const Pose motion{{ask.random.between(-1e4, 1e4), ask.random.between(-1e4, 1e4)},
                          ask.random.between(-3.0, 3.0)};
        Scene here(ask.placements);
        std::vector<Placement> moved = ask.placements;
        for (Placement& placement : moved) {
            placement.pose = moved_by(motion, placement.pose);
        }
        Scene there(moved);
        const ShapeHandle a = here.add_shape(ask.item);
        const ShapeHandle b = there.add_shape(ask.item);
        std::vector<Pose> poses = ask.questions.poses;
        std::vector<Vector2> points = ask.questions.points;
        std::vector<Clearance> clearances(poses.size());
        std::vector<NearestHit> hits(points.size());
        ASSERT_TRUE(here.world().find_clearances({a}, poses, clearances).ok());
        ASSERT_TRUE(here.world().find_nearest({}, points, hits).ok());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            poses[i] = moved_by(motion, poses[i]);
            points[i] = moved_by(motion, points[i]);
        }
        std::vector<Clearance> moved_clearances(poses.size());
        std::vector<NearestHit> moved_hits(points.size());
        ASSERT_TRUE(there.world().find_clearances({b}, poses, moved_clearances).ok());
        ASSERT_TRUE(there.world().find_nearest({}, points, moved_hits).ok());
        // Poses and points are rounded where they arrive, which no bound of the library covers.
        constexpr double arrival = 1e-11;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            EXPECT_NEAR(clearances[i].distance, moved_clearances[i].distance,
                        clearances[i].error_bound + moved_clearances[i].error_bound + arrival);
            EXPECT_NEAR(hits[i].distance, moved_hits[i].distance,
                        hits[i].error_bound + moved_hits[i].error_bound + arrival);
        }
    }
}

}  // namespace
}  // namespace nearfield::test
