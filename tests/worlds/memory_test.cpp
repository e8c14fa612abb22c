#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/allocations.hpp>
#include <tests/support/pair_tables.hpp>

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
        item = scene.add_shape(rectangle({0, 0}, {0.7, 0.4}));
        Random random(9);
        questions = any_questions(random, {{-1.0, -1.0}, {10.0, 9.0}}, 12);
        if (has_been_asked) {
            static_cast<void>(answers());
        }
    }

    Answers answers() {
        Answers answers([this](InstanceHandle handle) {
            const auto position = scene.position(handle);
            if (position || handle == InstanceHandle()) {
                return position ? static_cast<double>(*position) : -1.0;
            }
            return 1000.0 + handle.index;
        });
        answers.ask(scene.world(), item, questions);
        EXPECT_TRUE(answers.status().ok()) << answers.status().text();
        return answers;
    }

    Scene scene;
    ShapeHandle item;
    Questions questions;
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
                        .add({changed.item, {{0.2 * i, 0.25 * (i % 30)}, 0.2 * i}})
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
    const Call calls[] = {
        [](Changed& c) {
            std::vector<std::uint8_t> out(c.questions.poses.size());
            return c.scene.world().test_poses(c.item, c.questions.poses, out);
        },
        [](Changed& c) {
            const InstanceHandle a[] = {c.scene.handle(0), c.scene.handle(2)};
            const InstanceHandle b[] = {c.scene.handle(1), c.scene.handle(3)};
            PairTable out(IntersectionTestQuery{}, of_list);
            return c.scene.world().update(out, {.a = a, .b = b});
        },
        [](Changed& c) {
            const InstanceHandle a[] = {c.scene.handle(0), c.scene.handle(2)};
            const InstanceHandle b[] = {c.scene.handle(1), c.scene.handle(3)};
            PenetrationQuery query;
            query.tolerance = 0.02;
            query.points = PenetrationPoints::vertices;
            query.summary_only = true;
            PairTable out(query, of_list);
            return c.scene.world().update(out, {.a = a, .b = b});
        },
        [](Changed& c) {
            std::vector<Clearance> out(c.questions.poses.size());
            return c.scene.world().find_clearances({c.item}, c.questions.poses, out);
        },
        [](Changed& c) {
            std::vector<Clearance> out(2 * c.questions.poses.size());
            return c.scene.world().find_nearest({c.item, 2}, c.questions.poses, out);
        },
        [](Changed& c) {
            std::vector<ShapeEdgeHit> out(2 * c.questions.poses.size());
            return c.scene.world().find_nearest({c.item, 2}, c.questions.poses, out);
        },
        [](Changed& c) {
            TimeOfImpactQuery query;
            query.tolerance = 1e-3;
            PairTable out(query);
            const InstanceHandle moving[] = {c.scene.handle(0)};
            const Pose ends[] = {{{3.0, 3.0}, 1.0}};
            return c.scene.world().update(out, {.moving = moving, .ends = ends});
        },
        [](Changed& c) {
            std::vector<NearestHit> out(2 * c.questions.points.size());
            NearestQuery query;
            query.count = 2;
            return c.scene.world().find_nearest(query, c.questions.points, out);
        },
        [](Changed& c) {
            RayHits out;
            return c.scene.world().cast_rays(c.questions.segments, out);
        },
        [](Changed& c) {
            std::vector<ShapeCastHit> out(c.questions.sweeps.size());
            return c.scene.world().cast_shape({c.item, 1e-3}, c.questions.sweeps, out);
        },
        [](Changed& c) {
            InstanceLists out;
            return c.scene.world().find_overlaps(c.questions.rectangles, out);
        },
    };
    // Some of a call's allocations are those of its output, which fails the test's own call.
    for (std::size_t i = 0; i < std::size(calls); ++i) {
        for (std::size_t change = 0; change < std::size(changes); ++change) {
            SCOPED_TRACE(testing::Message() << "call " << i << ", change " << change);
            check_each_allocation(changes[change], [&](Changed& changed) {
                try {
                    return calls[i](changed);
                } catch (const std::bad_alloc&) {  // the test's own output
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
            const auto added = c.scene.world().add({c.item, {{1.0, 1.0}, 0.0}});
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
    explicit Frames(const JobSystem& jobs) : scene_(row_of_squares(), settings(jobs)) {
        Random random(4);
        questions_ = any_questions(random, {{-1.0, -1.0}, {10.0, 9.0}}, 200);
        item_ = scene_.add_shape(star(random, 300, 0.5));
        wide_ = rectangle({0, 0}, {1.2, 0.9});
        narrow_ = rectangle({0, 0}, {1.0, 1.0});
        for (std::size_t i = 0; i < squares; ++i) {
            handles_.push_back(scene_.handle(i));
            poses_.push_back(scene_.placements()[i].pose);
        }
        intersects_.resize(questions_.poses.size());
        clearances_.resize(questions_.poses.size());
        nearest_.resize(3 * questions_.points.size());
        hits_.resize(questions_.segments.size());
        casts_.resize(questions_.sweeps.size());
        nearest_of_item_.resize(3 * questions_.poses.size());
        edges_near_item_.resize(3 * questions_.poses.size());
        TimeOfImpactQuery impact;
        impact.tolerance = 1e-3;
        impacts_.emplace(impact);
    }

    void run(bool odd) {
        World& world = scene_.world();
        for (Pose& pose : poses_) {
            pose.translation.x += odd ? 0.3 : -0.3;
            pose.angle += odd ? 0.2 : -0.2;
        }
        ASSERT_TRUE(world.move(handles_, poses_).ok());
        ASSERT_TRUE(scene_.context().update_shape(scene_.shape(5), odd ? wide_ : narrow_).ok());
        const auto guest = world.add({item_, {{4.0, 4.0}, 0.0}});
        ASSERT_TRUE(guest.has_value());
        ask(world);
        ends_ = poses_;
        for (Pose& end : ends_) {
            end.translation.x += odd ? -0.3 : 0.3;
        }
        ASSERT_TRUE(world.update(*impacts_, {.moving = handles_, .ends = ends_}).ok());
        ASSERT_TRUE(world.remove(*guest).ok());
    }

private:
    static Settings settings(const JobSystem& jobs) {
        Settings settings;
        settings.jobs = jobs;
        return settings;
    }

    void ask(World& world) {
        NearestQuery three;
        three.count = 3;
        ASSERT_TRUE(world.test_poses(item_, questions_.poses, intersects_).ok());
        const std::span<const InstanceHandle> all(handles_);
        const PairTableInput pairs{.a = all.subspan(1), .b = all.first(all.size() - 1)};
        ASSERT_TRUE(world.update(tests_, pairs).ok());
        ASSERT_TRUE(world.update(vertices_, pairs).ok());
        ASSERT_TRUE(world.update(samples_, pairs).ok());
        ASSERT_TRUE(world.update(contacts_, pairs).ok());
        ASSERT_TRUE(world.find_clearances({item_}, questions_.poses, clearances_).ok());
        ASSERT_TRUE(world.find_nearest(three, questions_.points, nearest_).ok());
        ASSERT_TRUE(world.find_nearest({item_, 3}, questions_.poses, nearest_of_item_).ok());
        ASSERT_TRUE(world.find_nearest({item_, 3}, questions_.poses, edges_near_item_).ok());
        three.kind = NearestKind::edges;
        ASSERT_TRUE(world.find_nearest(three, questions_.points, nearest_).ok());
        ASSERT_TRUE(world.cast_rays(questions_.segments, hits_).ok());
        ASSERT_TRUE(world.cast_rays(questions_.segments, all_).ok());
        ASSERT_TRUE(world.cast_shape({item_, 1e-3}, questions_.sweeps, casts_).ok());
        ASSERT_TRUE(world.find_overlaps(questions_.rectangles, lists_).ok());
        ASSERT_TRUE(world.find_overlaps(questions_.points, lists_).ok());
        ASSERT_TRUE(world.find_overlaps(item_, questions_.poses, lists_).ok());
    }

    Scene scene_;
    Questions questions_;
    ShapeHandle item_;
    Rings wide_;
    Rings narrow_;
    std::vector<InstanceHandle> handles_;
    std::vector<Pose> poses_;
    std::vector<Pose> ends_;
    std::optional<PairTable<TimeOfImpactQuery>> impacts_;
    std::vector<std::uint8_t> intersects_;
    PairTable<IntersectionTestQuery> tests_{IntersectionTestQuery{}, of_list};
    PairTable<PenetrationQuery> vertices_{
        {.tolerance = 0.02, .points = PenetrationPoints::vertices, .summary_only = true}, of_list};
    PairTable<PenetrationQuery> samples_{{.tolerance = 0.02}, of_list};
    PairTable<ContactQuery> contacts_{{.tolerance = 0.02, .contact_distance = 0.05}, of_list};
    std::vector<Clearance> clearances_;
    std::vector<NearestHit> nearest_;
    std::vector<Clearance> nearest_of_item_;
    std::vector<ShapeEdgeHit> edges_near_item_;
    std::vector<RayHit> hits_;
    std::vector<ShapeCastHit> casts_;
    RayHits all_;
    InstanceLists lists_;
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
