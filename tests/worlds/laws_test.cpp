#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/run_on_threads.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using Job = void (*)(void* data, std::uint32_t number);

void run_backwards(void* user, std::uint32_t jobs, Job job, void* data) {
    for (std::uint32_t i = jobs; i-- > 0;) {
        job(data, i);
    }
    ++*static_cast<std::uint32_t*>(user);
}

/// A world, and questions about it.
struct Ask {
    explicit Ask(std::uint64_t seed, int count = 500)
        : random(seed),
          placements(make_scene(SceneKind::ordinary, seed)),
          item(scaled_and_moved(star(random, 17, 0.4), 0.5, {})),
          questions(any_questions(random, box_of(placements), count)) {}

    /// The answers of a scene, in which the item is added.
    Answers answers(Scene& scene) {
        questions.shape = scene.add_shape(item);
        return answers_of(scene, questions);
    }

    Random random;
    std::vector<Placement> placements;
    Rings item;
    Questions questions;
};

/// Answers by any number of jobs, twice, are those of one.
void expect_same_with_jobs(int inputs, std::initializer_list<std::uint32_t> counts) {
    Ask ask(3, inputs);
    Scene alone(ask.placements);
    const Answers expected = ask.answers(alone);
    ASSERT_GT(expected.size(), 10000U);
    for (const std::uint32_t count : counts) {
        std::uint32_t calls = 0;
        for (const JobSystem& jobs :
             {JobSystem{nullptr, count, run_on_threads}, JobSystem{&calls, count, run_backwards}}) {
            Scene scene(ask.placements, {.jobs = jobs});
            EXPECT_EQ(ask.answers(scene).difference_from(expected), "") << count << " jobs";
            const Answers again = answers_of(scene, ask.questions);
            EXPECT_EQ(again.difference_from(expected), "") << count << " jobs";
        }
        EXPECT_EQ(calls > 0, count > 1) << "the work is not divided";
    }
}

TEST(WorldJobs, GiveTheSameAnswersHoweverMany) {
    expect_same_with_jobs(500, {1, 2, 3, 7});
    // Of so many that lists are put together from many parts.
    expect_same_with_jobs(6000, {3});
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

/// Paths through a box, in short steps: what is known of one pose helps with the next.
std::vector<Pose> paths_through(Random& random, const Scene& scene, const Rectangle& box) {
    std::vector<Pose> poses;
    for (int path = 0; path < 4; ++path) {
        Pose pose{any_point(random, scene, box), random.between(-7.0, 7.0)};
        const double step =
            random.whole(0, 3) == 0 ? 0.0 : random.scale(1e-3, 0.1) * (box.max.x - box.min.x);
        const double turn = random.whole(0, 1) * random.between(-0.3, 0.3);
        const auto is_usable = [](double coordinate) {
            return std::abs(coordinate) <= largest_coordinate;
        };
        for (int i = 0; i < 30 && is_usable(pose.translation.x) && is_usable(pose.translation.y);
             ++i) {
            poses.push_back(pose);
            pose.translation.x += step * std::cos(pose.angle);
            pose.translation.y += step * std::sin(pose.angle);
            pose.angle += turn;
        }
    }
    return poses;
}

using WorldOneByOne = ScenesTest;

/// What is asked at the same time changes nothing.
TEST_P(WorldOneByOne, IsTheSameAsTogether) {
    for_each_scene(5, 47, [](Scene& scene, Random& random) {
        const Rectangle box = scene.box();
        Questions questions = any_questions(random, box, 0);
        questions.shape = any_asked(random, scene).shape;
        questions.options.filter = any_filter(random, scene);
        questions.tolerance = 1e-9 * size_of(GetParam(), box);
        questions.poses = paths_through(random, scene, box);
        for (int i = 0; i < 60; ++i) {
            const Vector2 point = any_point(random, scene, box);
            questions.points.push_back(point);
            questions.segments.push_back(any_segment(random, scene, box));
            questions.rectangles.push_back({point, {point.x + 0.3, point.y + 0.2}});
            if (i % 8 == 0) {
                questions.sweeps.push_back(
                    {{point, 0.0}, {any_point(random, scene, box), random.between(-3.0, 3.0)}});
            }
        }
        const Answers together = answers_of(scene, questions);
        Answers one_by_one(scene);
        const QuestionList list = questions_about_inputs();
        for (std::size_t i = 0; i < std::max<std::size_t>(60, questions.poses.size()); ++i) {
            one_by_one.ask(list, scene.world(), questions.about(i));
        }
        EXPECT_TRUE(one_by_one.status().ok()) << one_by_one.status().text();
        EXPECT_EQ(one_by_one.difference_from(together), "");
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldOneByOne, testing::ValuesIn(all_scene_kinds()));

TEST(WorldLaws, WhoeverOwnsTheWorldAndTheContext) {
    Ask ask(11);
    Scene scene(ask.placements);
    const Answers expected = ask.answers(scene);
    Context context(std::move(scene.context()));
    World world(std::move(scene.world()));
    const auto answers = [&](World& asked) {
        Answers all(scene);
        all.ask(asked, ask.questions);
        EXPECT_TRUE(all.status().ok()) << all.status().text();
        return all;
    };
    // Another world of the same context, in which the same shapes are in reverse order.
    const auto reversed = [&] {
        World other = std::move(*World::create(context));
        for (std::size_t i = scene.size(); i-- > 0;) {
            EXPECT_TRUE(other.add({scene.shape(i), ask.placements[i].pose}).has_value());
        }
        return other;
    };
    World other = reversed();
    (void)answers(other);
    EXPECT_EQ(answers(world).difference_from(expected), "");
    // Both see a shape that has changed.
    ask.placements[0].rings = rectangle({0, 0}, {90, 90});
    ASSERT_TRUE(context.update_shape(scene.shape(0), ask.placements[0].rings).ok());
    World fresh = reversed();
    EXPECT_EQ(answers(other).difference_from(answers(fresh)), "");
    const Answers later = answers(world);
    Scene deformed(ask.placements);
    EXPECT_EQ(later.difference_from(ask.answers(deformed)), "");
}

/// Numbers do not depend on the order of adding; only who comes first among equals does.
TEST(WorldLaws, TheOrderOfAddingDecidesTiesAlone) {
    for (int number = 0; number < random_cases(6); ++number) {
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
    for (int number = 0; number < random_cases(8); ++number) {
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
