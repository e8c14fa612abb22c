#include <nearfield/world.hpp>
#include <nearfield/world_device_queries.hpp>

#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/driver_errors.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::FailingAllocations;
using test_support::MockDriver;
using test_support::name_of;

/// Rays, points and poses that the device is asked about, taken through submissions of all kinds.
class QueriesOfDevice {
public:
    enum class Step {
        first,   ///< makes all
        moved,   ///< makes nothing
        larger,  ///< more questions, more instances, a larger shape
    };
    static constexpr Step steps[] = {Step::first, Step::moved, Step::larger};

    QueriesOfDevice() : life_(Technique::compute) {
        life_.take_all_before(World::Step::submit_first);
        Expected<nearfield::World> world = nearfield::World::create(life_.context());
        EXPECT_TRUE(world.has_value()) << world.error().text();
        world_.emplace(std::move(*world));
        add(4, 3);
    }

    [[nodiscard]] MockDriver& driver() { return life_.driver(); }
    [[nodiscard]] Status submit() { return world_->submit(rays_, segments_); }
    [[nodiscard]] Status ask() {
        std::vector<RayHit> hits(segments_.size());
        Status status = world_->cast_rays(rays_, segments_, hits);
        if (!status.ok()) {
            return status;
        }
        const std::vector<Vector2> points(segments_.size(), Vector2{0.2, 0.1});
        std::vector<NearestHit> near(points.size());
        status = world_->submit(nearest_, {}, points);
        status = status.ok() ? nearest_.collect(near) : status;
        if (!status.ok()) {
            return status;
        }
        const std::vector<Pose> poses(segments_.size());
        std::vector<std::uint8_t> meets(poses.size());
        return world_->test_poses(tests_, {.shape = shape_}, poses, meets);
    }

    void prepare(Step step) {
        if (step == Step::moved) {
            EXPECT_TRUE(world_->move(instances_.front(), {{0.5, 0.5}, 1.0}).ok());
        } else if (step == Step::larger) {
            segments_.resize(3'000, {{0.0, 0.0}, {1.0, 1.0}});
            add(10, 5000);
        }
    }
    void ask_all_before(Step step) {
        for (const Step earlier : steps) {
            if (earlier == step) {
                break;
            }
            prepare(earlier);
            const Status status = ask();
            ASSERT_TRUE(status.ok()) << status.text();
        }
        prepare(step);
    }
    void expect_to_work() {
        const Status status = ask();
        EXPECT_TRUE(status.ok()) << status.text();
    }
    void expect_an_answering_context() {
        std::vector<double> numbers;
        const Status status = life_.answer(numbers);
        EXPECT_TRUE(status.ok()) << status.text();
        static const std::vector<double> expected = numbers;
        EXPECT_EQ(numbers, expected);
    }
    void expect_to_be_lost() {
        EXPECT_EQ(ask().code(), StatusCode::device_lost);
        EXPECT_EQ(driver().work_after_loss(), std::vector<std::string>{});
    }
    void expect_to_leave_nothing() {
        rays_ = {};
        nearest_ = {};
        tests_ = {};
        world_.reset();
        EXPECT_TRUE(life_.take(World::Step::destroy).ok());
        EXPECT_EQ(driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(driver().breaches(), std::vector<std::string>{});
    }

private:
    /// Instances of a regular polygon.
    void add(int count, int corners) {
        Ring ring;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / corners;
            ring.push_back({std::cos(angle), std::sin(angle)});
        }
        const Expected<ShapeHandle> shape = life_.context().add_shape(std::vector<Ring>{ring});
        ASSERT_TRUE(shape.has_value()) << shape.error().text();
        shape_ = *shape;
        for (int i = 0; i < count; ++i) {
            const auto instance = world_->add({.shape = *shape, .pose = {{0.1 * i, 0.0}, 0.3}});
            ASSERT_TRUE(instance.has_value()) << instance.error().text();
            instances_.push_back(*instance);
        }
    }

    World life_;
    std::optional<nearfield::World> world_;
    DeviceRays rays_;
    DeviceNearest nearest_;
    DevicePoseTests tests_;
    ShapeHandle shape_;
    std::vector<Segment> segments_{10, {{-2.0, 0.0}, {2.0, 0.1}}};
    std::vector<InstanceHandle> instances_;
};

using Step = QueriesOfDevice::Step;

void try_error(Step step, std::string_view call, std::size_t successes, VkResult error) {
    SCOPED_TRACE(::testing::Message() << "step " << static_cast<int>(step) << ": call " << successes
                                      << " of " << call << " says " << name_of(error));
    QueriesOfDevice queries;
    queries.ask_all_before(step);
    queries.driver().fail(call, successes, error, MockDriver::Failing::from_then_on);
    const Status status = queries.ask();
    queries.driver().work_again();
    ASSERT_TRUE(queries.driver().has_failed());
    EXPECT_EQ(status.code(), code_of(error)) << status.text();
    EXPECT_NE(status.message().find(call), std::string::npos) << status.text();
    EXPECT_NE(status.message().find(name_of(error)), std::string::npos) << status.text();
    if (error == VK_ERROR_DEVICE_LOST) {
        queries.expect_to_be_lost();
    } else {
        queries.expect_to_work();
        queries.expect_an_answering_context();
    }
    queries.expect_to_leave_nothing();
}

std::vector<std::string_view> calls_of(Step step) {
    QueriesOfDevice queries;
    queries.ask_all_before(step);
    queries.driver().forget_calls();
    queries.expect_to_work();
    return queries.driver().calls();
}

TEST(DeviceQueriesOfDriver, NameFailingCallsLeakNothingAndWorkAfterwards) {
    for (const Step step : QueriesOfDevice::steps) {
        std::map<std::string_view, std::size_t> count;
        for (const std::string_view call : calls_of(step)) {
            for (const VkResult error : errors_of(call)) {
                try_error(step, call, count[call], error);
                if (testing::Test::HasFailure()) {
                    return;
                }
            }
            ++count[call];
        }
        EXPECT_EQ(count["vkQueueSubmit"], 3U);
        EXPECT_EQ(count["vkCreateBuffer"] > 0, step != Step::moved);
        EXPECT_EQ(count["vkUpdateDescriptorSets"] > 0, step != Step::moved);
    }
}

TEST(DeviceQueriesOfDriver, SayThatHostMemoryRunsOutAndWorkAfterwards) {
    for (const Step step : QueriesOfDevice::steps) {
        bool has_failed = true;
        for (std::uint64_t successes = 0; has_failed; ++successes) {
            SCOPED_TRACE(::testing::Message() << "step " << static_cast<int>(step)
                                              << ": memory for " << successes << " allocations");
            QueriesOfDevice queries;
            queries.ask_all_before(step);
            std::vector<RayHit> hits(10);
            Status status;
            {
                const FailingAllocations scarce(successes);
                status = queries.submit();
            }
            has_failed = FailingAllocations::has_failed();
            EXPECT_EQ(status.code(), has_failed ? StatusCode::out_of_memory : StatusCode::ok)
                << status.text();
            if (has_failed) {
                queries.expect_to_work();
                queries.expect_an_answering_context();
            }
            queries.expect_to_leave_nothing();
            if (testing::Test::HasFailure()) {
                return;
            }
        }
    }
}

/// As nothing of the context, rays that are still on the device leave nothing.
TEST(DeviceQueriesInFlight, AreWaitedForByTheirDestructor) {
    QueriesOfDevice queries;
    EXPECT_TRUE(queries.submit().ok());
    queries.expect_to_leave_nothing();
}

}  // namespace
}  // namespace nearfield::test
