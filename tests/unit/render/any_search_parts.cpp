#include <engine/base/status_exception.hpp>

#include <tests/support/polygons.hpp>
#include <tests/unit/render/searched.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace nearfield::render {
namespace {

using device_input::FoundPoints;
using device_input::PairGoal;
using device_input::PairQuestion;
using test::Random;

PairCounts any_counts(Random& random, const device_input::PairSearchKind& kind) {
    const double pairs = random.scale(0.5, random.whole(0, 20) == 0 ? 20000.0 : 300.0);
    const auto share = [&](double most) {
        return static_cast<std::uint32_t>(pairs * random.between(0.0, most));
    };
    PairCounts counts{share(20.0), share(60.0), share(30.0), static_cast<std::uint32_t>(pairs),
                      share(4.0),  share(1.0)};
    if (kind.goal == PairGoal::tests) {
        counts[shaders::point_total] = 0;
    }
    if (kind.points == FoundPoints::compared) {
        counts[shaders::record_total] = 0;
    }
    return counts;
}

PairQuestion any_question(Random& random) {
    constexpr std::array goals{PairGoal::penetrations, PairGoal::contacts, PairGoal::tests};
    PairQuestion question{.goal = goals[static_cast<std::size_t>(random.whole(0, 3))]};
    question.records = question.goal != PairGoal::tests && random.whole(0, 2) == 0;
    question.on_device = question.goal == PairGoal::penetrations && random.whole(0, 2) == 0;
    return question;
}

/// Worlds whose instances come, go and move, within limits that may be too tight for them.
class AnyWorld {
public:
    explicit AnyWorld(std::uint64_t seed)
        : random_(seed),
          question_(any_question(random_)),
          world_(question_, {}),
          recorded_(world_),
          parts_(parts_of(question_)) {
        resize(400);
        // What parts have room for at least, before anything was counted.
        const PairBytes least = world_.bytes({64, 64, 64, 64, 64, 64});
        resize(random_.whole(1, 200));
        const PairBytes all = world_.bytes(world_.counts(0, world_.size()));
        const auto limit = [&](std::uint64_t bytes) {
            return static_cast<std::uint64_t>(random_.scale(0.02, 8.0) *
                                              static_cast<double>(bytes));
        };
        limits_ = {std::max(limit(all.largest()), least.largest()),
                   std::max(limit(all.scratch + all.found()), 2 * least.scratch)};
    }

    void step() {
        if (has_results_ && random_.whole(0, 3) == 0) {
            record();
        }
        if (random_.whole(0, 3) == 0) {
            resize(random_.whole(1, 400));
        }
        move();
        try {
            update();
        } catch (const StatusException& error) {
            EXPECT_EQ(error.status().code(), StatusCode::too_large);
            EXPECT_TRUE(is_too_large(world_) || is_too_large(recorded_))
                << error.status().message();
            parts_ = parts_of(question_);  // as a table starts anew
            has_results_ = false;
        }
    }

private:
    void resize(int count) {
        while (world_.size() < static_cast<std::uint32_t>(count)) {
            world_.instances().push_back(any_counts(random_, question_.kind()));
        }
        world_.instances().resize(static_cast<std::size_t>(count));
    }

    void move() {
        for (PairCounts& counts : world_.instances()) {
            counts = random_.whole(0, 4) == 0 ? any_counts(random_, question_.kind()) : counts;
        }
    }

    /// A search in a frame of the host's, which is not repeated where there was no room.
    void record() {
        move();
        for (std::size_t i = 0; i < parts_.count(); ++i) {
            const PairCounts own = world_.counted(parts_[i]);
            if (is_within(own, parts_[i].capacities)) {
                parts_.note(i, own);
            } else {
                parts_.grow(i, own, 1.0);
                has_results_ = false;
            }
        }
        recorded_ = world_;
    }

    void update() {
        const std::size_t before = parts_.count();
        if (has_results_ && parts_.join(limits_)) {
            parts_.fit(limits_);
            EXPECT_EQ(parts_.count(), before - 1) << "what was joined is not divided";
        }
        has_results_ = false;
        world_.search(parts_, limits_);
        has_results_ = true;
        for (std::size_t i = 0; i < parts_.count(); ++i) {
            EXPECT_EQ(parts_[i].needed, world_.counts(parts_[i]));
        }
    }

    /// Whether no division fits, but for what rounding up in each part may add.
    [[nodiscard]] bool is_too_large(const Searched& world) const {
        const PairCounts all = world.counts(0, world.size());
        const PairBytes found = world.bytes(all);
        const PairBytes resident = world.resident_bytes(all);
        std::uint64_t largest = 0;
        std::uint64_t scratch = 0;
        for (std::uint32_t i = 0; i < world.size(); ++i) {
            const PairBytes own = world.bytes(world.counts(i, i + 1));
            largest = std::max(largest, own.largest());
            scratch = std::max(scratch, own.scratch);
        }
        const std::uint64_t sum = scratch + found.found() + resident.found();
        const std::uint64_t rounding = 200 * world.size();
        return largest > limits_.reach || resident.largest() + rounding > limits_.reach ||
               sum + rounding > limits_.memory;
    }

    Random random_;
    PairQuestion question_;
    Searched world_;
    Searched recorded_;  // what the last frame of the host was about
    PairParts parts_;
    PairLimits limits_;
    bool has_results_ = false;
};

TEST(PairParts, OfAnyWorldHaveEachInstanceOnceAndFit) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        AnyWorld world(seed);
        for (int i = 0; i < 10; ++i) {
            world.step();
        }
    }
}

}  // namespace
}  // namespace nearfield::render
