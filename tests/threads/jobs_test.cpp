#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/query/all_numbers.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/run_on_threads.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using Job = void (*)(void* data, std::uint32_t number);

/// Runs the jobs one after the other, starting with a different one each time; reports their
/// number.
void run_in_turn(void* user, std::uint32_t jobs, Job job, void* data) {
    auto& calls = *static_cast<std::uint32_t*>(user);
    for (std::uint32_t i = 0; i < jobs; ++i) {
        job(data, (calls + i) % jobs);
    }
    ++calls;
}

void leave_one_out(void* /*user*/, std::uint32_t jobs, Job job, void* data) {
    for (std::uint32_t i = 1; i < jobs; ++i) {
        job(data, i);
    }
}

/// Runs the jobs one after the other; reports their number.
void count_jobs(void* user, std::uint32_t jobs, Job job, void* data) {
    *static_cast<std::uint32_t*>(user) = jobs;
    for (std::uint32_t i = 0; i < jobs; ++i) {
        job(data, i);
    }
}

/// Memory runs out in the second job.
void run_out_of_memory(void* user, std::uint32_t jobs, Job job, void* data) {
    for (std::uint32_t i = 0; i < jobs; ++i) {
        std::optional<test_support::FailingAllocations> none;
        if (i == 1) {
            none.emplace(0);
        }
        job(data, i);
        *static_cast<bool*>(user) |= test_support::FailingAllocations::has_failed();
    }
}

/// Forty shapes side by side, a large one over all of them, and every kind of query on them.
class Crowd {
public:
    explicit Crowd(const JobSystem& jobs) {
        Settings settings;
        settings.jobs = jobs;
        Expected<Context> made = Context::create_cpu(settings);
        EXPECT_TRUE(made.has_value()) << made.error().text();
        if (!made) {
            return;
        }
        context_.emplace(std::move(*made));
        Random random(7);
        for (int i = 0; i < 40; ++i) {
            const Vector2 at{1.6 * (i % 8), 1.6 * (i / 8)};
            add(star(random, 50, 0.6), {at, random.between(0.0, 6.0)});
        }
        add(scaled_and_moved(coast(random, 1500, 0.4), 6.0, {}), {{6.0, 3.0}, 0.0});
        fill();
    }

    Status run() { return context_->run(batch_, results_); }

    [[nodiscard]] std::vector<double> numbers() const { return all_numbers(results_); }

private:
    void add(const Rings& rings, const Pose& pose) {
        const Expected<ShapeHandle> shape = context_->add_shape(rings);
        EXPECT_TRUE(shape.has_value()) << shape.error().text();
        instances_.push_back({shape.has_value() ? *shape : ShapeHandle{}, pose});
    }
    void fill() {
        const auto pairs = context_->find_overlapping_boxes(instances_, 0.0);
        ASSERT_TRUE(pairs.has_value()) << pairs.error().text();
        EXPECT_GT(pairs->size(), 60U);
        for (const InstancePair& pair : *pairs) {
            const Instance a = instances_[pair.first];
            const Instance b = instances_[pair.second];
            for (const auto points : {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
                batch_.add(PenetrationQuery{a, b, 0.02, points, false, Technique::cpu});
                batch_.add(PenetrationQuery{b, a, 0.02, points, false, Technique::cpu});
            }
            batch_.add(IntersectionTestQuery{a, b});
            batch_.add(ContainmentQuery{a, b});
            batch_.add(SeparationQuery{a, b, 0.02, Technique::cpu});
        }
        for (std::size_t i = 1; i < 4; ++i) {
            const Instance a = instances_[i - 1];
            const Instance b = instances_[i];
            ContactQuery contacts{a, b, 0.05, 0.1};
            contacts.technique = Technique::cpu;
            batch_.add(contacts);
            IntersectionQuery common{a, b, 0.05};
            common.technique = Technique::cpu;
            batch_.add(common);
            DistanceFieldQuery field;
            field.a = a;
            field.b = b;
            field.tolerance = 0.02;
            field.technique = Technique::cpu;
            batch_.add(field);
        }
    }

    std::optional<Context> context_;
    std::vector<Instance> instances_;
    Batch batch_;
    Results results_;
};

/// The results of a single thread.
std::vector<double> found_alone() {
    Crowd crowd({});
    const Status status = crowd.run();
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_GT(crowd.numbers().size(), 10000U);
    return crowd.numbers();
}

TEST(Jobs, GiveTheSameAnswersAsNone) {
    const auto expected = found_alone();
    for (const std::uint32_t count : {1U, 2U, 3U, 8U}) {
        SCOPED_TRACE(count);
        Crowd crowd({nullptr, count, run_on_threads});
        for (int frame = 0; frame < 2; ++frame) {
            const Status status = crowd.run();
            ASSERT_TRUE(status.ok()) << status.text();
            EXPECT_EQ(crowd.numbers(), expected);
        }
    }
}

TEST(Jobs, AllocateNothingInTheLongRunWhoeverDoesThem) {
    std::uint32_t calls = 0;
    Crowd crowd({&calls, 5, run_in_turn});
    for (int frame = 0; frame < 3; ++frame) {
        ASSERT_TRUE(crowd.run().ok());
    }
    ASSERT_EQ(calls, 3U);
    const std::uint64_t before = test_support::allocation_count();
    for (int frame = 0; frame < 6; ++frame) {
        ASSERT_TRUE(crowd.run().ok());
    }
    EXPECT_EQ(calls, 9U);
    EXPECT_EQ(test_support::allocation_count(), before);
}

/// The number of jobs, at most eight, for four pairs of squares whose boundaries have `samples`
/// samples each; 0 if no jobs are used.
std::uint32_t jobs_for(double samples) {
    std::uint32_t jobs = 0;
    Settings settings;
    settings.jobs = {&jobs, 8, count_jobs};
    Expected<Context> context = Context::create_cpu(settings);
    EXPECT_TRUE(context.has_value()) << context.error().text();
    const std::vector<Ring> square{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
    const Expected<ShapeHandle> shape = context->add_shape(square);
    EXPECT_TRUE(shape.has_value());
    Batch batch;
    for (int i = 0; i < 4; ++i) {
        const Instance b{*shape, {{0.1 + 0.2 * i, 0.5}, 0.0}};
        PenetrationQuery query{{*shape, {}}, b, 4.0 / samples};
        query.summary_only = true;
        query.technique = Technique::cpu;
        batch.add(query);
    }
    Results results;
    const Status status = context->run(batch, results);
    EXPECT_TRUE(status.ok()) << status.text();
    return jobs;
}

TEST(Jobs, AreDealtOutBySamples) {
    EXPECT_EQ(jobs_for(40.0), 0U);
    EXPECT_EQ(jobs_for(20000.0), 4U);
}

TEST(Jobs, ThatWereNotDoneAreAnError) {
    Crowd crowd({nullptr, 4, leave_one_out});
    const Status status = crowd.run();
    EXPECT_EQ(status.code(), StatusCode::invalid_settings);
    EXPECT_NE(status.message().find("job 0 of 4"), std::string::npos) << status.text();
}

TEST(Jobs, CarryOverWhatGoesWrongInOne) {
    bool has_failed = false;
    Crowd crowd({&has_failed, 4, run_out_of_memory});
    const Status status = crowd.run();
    EXPECT_TRUE(has_failed);
    EXPECT_EQ(status.code(), StatusCode::out_of_memory) << status.text();
}

TEST(Jobs, ThatCannotBeUsedAreRefused) {
    const auto code = [](const JobSystem& jobs) {
        Settings settings;
        settings.jobs = jobs;
        const Status status = Context::create_cpu(settings).error();
        EXPECT_NE(status.message().find("Settings::jobs"), std::string::npos) << status.text();
        return status.code();
    };
    EXPECT_EQ(code({nullptr, 2, nullptr}), StatusCode::invalid_settings);
    EXPECT_EQ(code({nullptr, 0, run_on_threads}), StatusCode::invalid_settings);
    EXPECT_EQ(code({nullptr, max_jobs + 1, run_on_threads}), StatusCode::invalid_settings);
}

}  // namespace
}  // namespace nearfield::test
