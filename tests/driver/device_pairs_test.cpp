#include <nearfield/device_poses.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_device.hpp>
#include <passes/compute_layout.hpp>

#include <gtest/gtest.h>
#include <shaders/pairs.h>
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

/// More than there is room for at first.
constexpr std::uint32_t pairs_found = 20'000;
constexpr std::uint32_t word_of_pairs = plan::pair_total;

/// How a table is brought up to date.
enum class Way {
    at_once,
    by_halves,  ///< submitted, and then collected
    on_device,  ///< at once, at poses in a buffer of the host's; results stay there too
    recorded,   ///< likewise, into a command buffer of the host, which submits it
};

/// A table of pairs that the device finds, taken through updates of all kinds.
class PairsOfDevice {
public:
    enum class Step {
        first,   ///< makes all, and then room for all pairs
        moved,   ///< submits the same commands again
        larger,  ///< more instances, of a larger shape
    };
    static constexpr Step steps[] = {Step::first, Step::moved, Step::larger};

    explicit PairsOfDevice(Way way)
        : way_(way), life_(Technique::compute), table_(PenetrationQuery{.tolerance = 0.05}) {
        life_.take_all_before(World::Step::submit_first);
        driver().let_shaders_find({passes::ComputeLayout::output, pairs_found, word_of_pairs});
        Expected<nearfield::World> world = nearfield::World::create(life_.context());
        EXPECT_TRUE(world.has_value()) << world.error().text();
        world_.emplace(std::move(*world));
        poses_.buffer = driver().make_buffer();
        poses_.size = 1U << 20U;
        poses_.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        add(4, 3);
    }

    [[nodiscard]] MockDriver& driver() { return life_.driver(); }
    [[nodiscard]] Status submit() { return world_->submit(table_); }
    [[nodiscard]] Status update() {
        if (way_ == Way::at_once) {
            return world_->update(table_);
        }
        if (way_ == Way::on_device) {
            return world_->update(table_, poses_);
        }
        if (way_ == Way::recorded) {
            Status status = record();
            return status.code() == StatusCode::overflow ? record() : status;
        }
        Status status = submit();
        return status.ok() ? table_.collect() : status;
    }
    [[nodiscard]] const DevicePairTable<PenetrationQuery>& table() const { return table_; }

    /// What the host changes before the update of a step.
    void prepare(Step step) {
        if (step == Step::moved) {
            EXPECT_TRUE(world_->move(instances_.front(), {{0.5, 0.5}, 1.0}).ok());
        } else if (step == Step::larger) {
            add(100, 5000);
        }
    }
    void update_all_before(Step step) {
        for (const Step earlier : steps) {
            if (earlier == step) {
                break;
            }
            prepare(earlier);
            const Status status = update();
            ASSERT_TRUE(status.ok()) << status.text();
        }
        prepare(step);
    }

    void expect_nothing() const {
        EXPECT_EQ(table_.size(), 0U);
        EXPECT_EQ(table_.candidates(), 0U);
        EXPECT_EQ(table_.left_to_cpu(), 0U);
    }
    void expect_to_work() {
        const Status status = update();
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(table_.candidates(), pairs_found);
    }
    void expect_an_answering_context() {
        driver().let_shaders_find({});
        std::vector<double> numbers;
        const Status status = life_.answer(numbers);
        EXPECT_TRUE(status.ok()) << status.text();
        static const std::vector<double> expected = numbers;
        EXPECT_EQ(numbers, expected);
    }
    void expect_to_be_lost() {
        EXPECT_EQ(update().code(), StatusCode::device_lost);
        expect_nothing();
        EXPECT_EQ(driver().work_after_loss(), std::vector<std::string>{});
        Results results;
        EXPECT_EQ(life_.context().run(life_.batch(8), results).code(), StatusCode::device_lost);
    }
    void expect_to_leave_nothing() {
        table_ = DevicePairTable(PenetrationQuery{});
        world_.reset();
        EXPECT_TRUE(life_.take(World::Step::destroy).ok());
        EXPECT_EQ(driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(driver().breaches(), std::vector<std::string>{});
    }

private:
    /// A frame of the host.
    Status record() {
        const VkCommandBuffer commands = driver().begin_commands();
        Status status = world_->record(table_, poses_, {.commands = commands, .frame = ++frame_});
        if (!status.ok()) {
            return status;
        }
        driver().submit(commands);
        driver().finish_submissions();
        life_.context().frame_completed(frame_);
        return table_.collect();
    }
    /// Instances of a regular polygon.
    void add(int count, int corners) {
        Ring ring;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / corners;
            ring.push_back({std::cos(angle), std::sin(angle)});
        }
        const Expected<ShapeHandle> shape = life_.context().add_shape(std::vector<Ring>{ring});
        ASSERT_TRUE(shape.has_value()) << shape.error().text();
        for (int i = 0; i < count; ++i) {
            const auto instance = world_->add({.shape = *shape, .pose = {{0.1 * i, 0.0}, 0.3}});
            ASSERT_TRUE(instance.has_value()) << instance.error().text();
            instances_.push_back(*instance);
        }
    }

    Way way_;
    World life_;
    std::optional<nearfield::World> world_;
    DevicePairTable<PenetrationQuery> table_;
    std::vector<InstanceHandle> instances_;
    DevicePoses poses_;
    std::uint64_t frame_ = 1000;  // others are before
};

using Step = PairsOfDevice::Step;

void try_error(Way way, Step step, std::string_view call, std::size_t successes, VkResult error) {
    SCOPED_TRACE(::testing::Message() << "step " << static_cast<int>(step) << ": call " << successes
                                      << " of " << call << " says " << name_of(error));
    PairsOfDevice pairs(way);
    pairs.update_all_before(step);
    pairs.driver().fail(call, successes, error, MockDriver::Failing::from_then_on);
    const Status status = pairs.update();
    pairs.driver().work_again();
    ASSERT_TRUE(pairs.driver().has_failed());
    EXPECT_EQ(status.code(), code_of(error)) << status.text();
    EXPECT_NE(status.message().find(call), std::string::npos) << status.text();
    EXPECT_NE(status.message().find(name_of(error)), std::string::npos) << status.text();
    pairs.expect_nothing();
    if (error == VK_ERROR_DEVICE_LOST) {
        pairs.expect_to_be_lost();
    } else {
        pairs.expect_to_work();
        pairs.expect_an_answering_context();
    }
    pairs.expect_to_leave_nothing();
}

std::vector<std::string_view> calls_of(Way way, Step step) {
    PairsOfDevice pairs(way);
    pairs.update_all_before(step);
    pairs.driver().forget_calls();
    pairs.expect_to_work();
    return pairs.driver().calls();
}

class DevicePairsOfDriver : public ::testing::TestWithParam<Way> {};

TEST_P(DevicePairsOfDriver, NameFailingCallsLeakNothingAndWorkAfterwards) {
    for (const Step step : PairsOfDevice::steps) {
        std::map<std::string_view, std::size_t> count;
        for (const std::string_view call : calls_of(GetParam(), step)) {
            for (const VkResult error : errors_of(call)) {
                try_error(GetParam(), step, call, count[call], error);
                if (HasFailure()) {
                    return;
                }
            }
            ++count[call];
        }
        // What was submitted with more room takes no poses of the host, so that is recorded anew.
        const std::uint32_t anew = GetParam() == Way::on_device ? 1 : 0;
        const std::uint32_t own = GetParam() == Way::recorded ? 0 : 1;
        EXPECT_EQ(count["vkQueueSubmit"], own * (step == Step::first ? 2 : 1));
        EXPECT_EQ(count["vkBeginCommandBuffer"], own * (step == Step::first   ? 2
                                                        : step == Step::moved ? anew
                                                                              : 1));
        EXPECT_EQ(count["vkCreateBuffer"] > 0, step != Step::moved);
    }
}

TEST_P(DevicePairsOfDriver, SayThatHostMemoryRunsOutAndWorkAfterwards) {
    for (const Step step : PairsOfDevice::steps) {
        bool has_failed = true;
        for (std::uint64_t successes = 0; has_failed; ++successes) {
            SCOPED_TRACE(::testing::Message() << "step " << static_cast<int>(step)
                                              << ": memory for " << successes << " allocations");
            PairsOfDevice pairs(GetParam());
            pairs.update_all_before(step);
            Status status;
            {
                const FailingAllocations scarce(successes);
                status = pairs.update();
            }
            has_failed = FailingAllocations::has_failed();
            EXPECT_EQ(status.code(), has_failed ? StatusCode::out_of_memory : StatusCode::ok)
                << status.text();
            if (has_failed) {
                pairs.expect_nothing();
            }
            pairs.expect_to_work();
            pairs.expect_an_answering_context();
            pairs.expect_to_leave_nothing();
            if (HasFailure()) {
                return;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Ways, DevicePairsOfDriver,
                         ::testing::Values(Way::at_once, Way::by_halves, Way::on_device,
                                           Way::recorded));

/// As nothing of the context, a table that is still on the device leaves nothing.
TEST(DevicePairsInFlight, AreWaitedForByTheirDestructor) {
    PairsOfDevice pairs(Way::by_halves);
    EXPECT_TRUE(pairs.submit().ok());
    pairs.expect_to_leave_nothing();
}

}  // namespace
}  // namespace nearfield::test
