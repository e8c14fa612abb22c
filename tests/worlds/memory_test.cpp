#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/allocations.hpp>

#include <functional>

namespace nearfield::test {
namespace {

using test_support::FailingAllocations;

constexpr std::size_t squares = 30;

std::vector<Placement> row_of_squares() {
    std::vector<Placement> placements;
    for (std::size_t i = 0; i < squares; ++i) {
        placements.push_back({"square",
                              rectangle({0, 0}, {1, 1}),
                              {{1.5 * static_cast<double>(i % 6), 1.5 * static_cast<double>(i / 6)},
                               0.1 * static_cast<double>(i)}});
    }
    return placements;
}

/// A world in which something has changed since it was last asked.
struct Changed {
    explicit Changed(bool has_been_asked) : scene(row_of_squares()) {
        Random random(9);
        about = any_questions(random, {{-1.0, -1.0}, {10.0, 9.0}}, 12);
        about.shape = scene.add_shape(rectangle({0, 0}, {0.7, 0.4}));
        about.a = {scene.handle(0), scene.handle(2)};
        about.b = {scene.handle(1), scene.handle(3)};
        about.moving = {scene.handle(0)};
        about.ends = {{{3.0, 3.0}, 1.0}};
        if (has_been_asked) {
            static_cast<void>(answers());
        }
    }

    Answers answers() { return answers_of(scene, about); }

    Scene scene;
    Questions about;
    QuestionList questions = questions_but_about_found_pairs();
};

using Change = std::function<void(Changed&)>;
using Call = std::function<Status(Changed&)>;

/// Makes every allocation of a call fail, one world each. The call fails, and all answers are then
/// those of a world in which it was not made; or it succeeds, and they are those of one in which it
/// was.
void check_each_allocation(const Change& change, const Call& call) {
    for (const bool has_been_asked : {false, true}) {
        Changed without(has_been_asked);
        change(without);
        const Answers before = without.answers();
        Changed with(has_been_asked);
        change(with);
        ASSERT_TRUE(call(with).ok());
        const Answers after = with.answers();
        bool has_failed = true;
        for (std::uint64_t successes = 0; has_failed; ++successes) {
            SCOPED_TRACE(testing::Message()
                         << successes << " allocations succeed, asked before: " << has_been_asked);
            Changed changed(has_been_asked);
            change(changed);
            Status status;
            {
                const FailingAllocations failing(successes);
                status = call(changed);
                has_failed = FailingAllocations::has_failed();
            }
            EXPECT_EQ(status.code(), has_failed ? StatusCode::out_of_memory : StatusCode::ok);
            const Answers answers = changed.answers();
            EXPECT_EQ(answers.difference_from(has_failed ? before : after), "");
            if (testing::Test::HasFailure()) {
                return;
            }
            ASSERT_LT(successes, 2000U);
        }
    }
}

void add_many(Changed& changed) {
    for (int i = 0; i < 40; ++i) {
        ASSERT_TRUE(changed.scene.world()
                        .add({changed.about.shape, {{0.2 * i, 0.25 * (i % 30)}, 0.2 * i}})
                        .has_value());
    }
}

void scatter(Changed& changed) {
    for (std::size_t i = 0; i < squares; ++i) {
        const auto step = static_cast<double>((7 * i) % squares);
        ASSERT_TRUE(
            changed.scene.world().move(changed.scene.handle(i), {{step, 3.0 * step}, step}).ok());
    }
}

void deform(Changed& changed) {
    for (std::size_t i = 0; i < squares; i += 2) {
        ASSERT_TRUE(changed.scene.context()
                        .update_shape(changed.scene.shape(i), rectangle({0, 0}, {1.5, 0.5}))
                        .ok());
    }
}

void change_nothing(Changed& /*changed*/) {}

const Change changes[] = {change_nothing, add_many, scatter, deform};

TEST(WorldMemory, RunningOutInAQueryChangesNothing) {
    for (std::size_t i = 0; i < questions_but_about_found_pairs().size(); ++i) {
        for (std::size_t change = 0; change < std::size(changes); ++change) {
            SCOPED_TRACE(testing::Message() << "question " << i << ", change " << change);
            check_each_allocation(changes[change], [i](Changed& changed) {
                try {
                    return changed.questions[i]->ask(changed.scene.world(), changed.about);
                } catch (const std::bad_alloc&) {  // the test's own room for answers
                    return Status(StatusCode::out_of_memory);
                }
            });
            if (HasFailure()) {
                return;
            }
        }
    }
}

TEST(WorldMemory, RunningOutInAnUpdateChangesNothing) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < squares; ++i) {
        poses.push_back({{0.3 * static_cast<double>(i), 2.0}, 0.0});
    }
    const Call calls[] = {
        [](Changed& c) {
            const auto added = c.scene.world().add({c.about.shape, {{1.0, 1.0}, 0.0}});
            return added ? Status() : added.error();
        },
        [&](Changed& c) {
            static std::vector<InstanceHandle> handles(squares);
            for (std::size_t i = 0; i < squares; ++i) {
                handles[i] = c.scene.handle(i);
            }
            return c.scene.world().move(handles, poses);
        },
        [](Changed& c) { return c.scene.world().remove(c.scene.handle(3)); },
        [](Changed& c) { return c.scene.world().set_filter(c.scene.handle(3), 0, 0); },
    };
    for (std::size_t i = 0; i < std::size(calls); ++i) {
        for (std::size_t change = 0; change < std::size(changes); ++change) {
            SCOPED_TRACE(testing::Message() << "call " << i << ", change " << change);
            check_each_allocation(changes[change], calls[i]);
            if (HasFailure()) {
                return;
            }
        }
    }
}

TEST(WorldMemory, RunningOutDoesNotKeepFromGivingBack) {
    for (const Change& change : changes) {
        Changed changed(true);
        change(changed);
        const Answers expected = changed.answers();
        {
            const FailingAllocations failing(0);
            changed.scene.world().trim();
        }
        EXPECT_EQ(changed.answers().difference_from(expected), "");
    }
}

TEST(WorldMemory, IsCountedAndGivenBack) {
    Changed changed(false);
    World& world = changed.scene.world();
    const std::uint64_t before = world.memory_use();
    const Answers expected = changed.answers();
    const std::uint64_t kept = world.memory_use();
    // At least the coordinates of every edge were kept.
    EXPECT_GE(kept, before + squares * 4 * 4 * sizeof(double));
    world.trim();
    EXPECT_LT(world.memory_use(), kept);
    EXPECT_LE(world.memory_use(), before + squares * 200);
    EXPECT_EQ(changed.answers().difference_from(expected), "");
}

void run_in_turn(void* user, std::uint32_t jobs, void (*job)(void* data, std::uint32_t),
                 void* data) {
    auto& calls = *static_cast<std::uint32_t*>(user);
    for (std::uint32_t i = 0; i < jobs; ++i) {
        job(data, (calls + i) % jobs);
    }
    ++calls;
}

/// A host's frame: things move and deform, one comes and one goes, everything is asked.
class Frames {
public:
    explicit Frames(const JobSystem& jobs) : scene_(row_of_squares(), {.jobs = jobs}) {
        Random random(4);
        about_ = any_questions(random, {{-1.0, -1.0}, {10.0, 9.0}}, 200);
        about_.shape = scene_.add_shape(star(random, 300, 0.5));
        for (std::size_t i = 0; i < squares; ++i) {
            about_.moving.push_back(scene_.handle(i));
            poses_.push_back(scene_.placements()[i].pose);
        }
        about_.a.assign(about_.moving.begin() + 1, about_.moving.end());
        about_.b.assign(about_.moving.begin(), about_.moving.end() - 1);
    }

    void run(bool odd) {
        World& world = scene_.world();
        for (Pose& pose : poses_) {
            pose.translation.x += odd ? 0.3 : -0.3;
            pose.angle += odd ? 0.2 : -0.2;
        }
        ASSERT_TRUE(world.move(about_.moving, poses_).ok());
        ASSERT_TRUE(scene_.context().update_shape(scene_.shape(5), odd ? wide_ : narrow_).ok());
        const auto guest = world.add({about_.shape, {{4.0, 4.0}, 0.0}});
        ASSERT_TRUE(guest.has_value());
        about_.ends = poses_;
        for (Pose& end : about_.ends) {
            end.translation.x += odd ? -0.3 : 0.3;
        }
        for (const std::unique_ptr<Question>& question : questions_) {
            ASSERT_TRUE(question->ask(world, about_).ok());
        }
        ASSERT_TRUE(world.remove(*guest).ok());
    }

private:
    Scene scene_;
    Questions about_;
    QuestionList questions_ = questions_but_about_found_pairs();
    Rings wide_ = rectangle({0, 0}, {1.2, 0.9});
    Rings narrow_ = rectangle({0, 0}, {1.0, 1.0});
    std::vector<Pose> poses_;
};

TEST(WorldMemory, OfAFrameLikeTheOneBeforeIsNone) {
    std::uint32_t calls = 0;
    for (const JobSystem& jobs : {JobSystem{}, JobSystem{&calls, 3, run_in_turn}}) {
        Frames frames(jobs);
        for (int frame = 0; frame < 6; ++frame) {
            frames.run(frame % 2 == 0);
        }
        const std::uint64_t before = test_support::allocation_count();
        for (int frame = 0; frame < 4; ++frame) {
            frames.run(frame % 2 == 0);
        }
        EXPECT_EQ(test_support::allocation_count() - before, 0U);
    }
    EXPECT_GT(calls, 0U);
}

}  // namespace
}  // namespace nearfield::test
