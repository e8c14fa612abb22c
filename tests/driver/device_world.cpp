#include <gtest/gtest.h>
#include <tests/driver/device_world.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/driver_errors.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::FailingAllocations;
using test_support::MockDriver;
using test_support::name_of;
void try_error(const MakeDeviceWorld& make, DeviceWorld::Step step, std::string_view call,
               std::size_t successes, VkResult error) {
    SCOPED_TRACE(::testing::Message() << "step " << static_cast<int>(step) << ": call " << successes
                                      << " of " << call << " says " << name_of(error));
    const auto asked = make();
    asked->ask_all_before(step);
    const auto ask_in_vain = [&](std::size_t successes_before) {
        asked->driver().fail(call, successes_before, error, MockDriver::Failing::from_then_on);
        const Status status = asked->ask();
        asked->driver().work_again();
        ASSERT_TRUE(asked->driver().has_failed());
        EXPECT_EQ(status.code(), code_of(error)) << status.text();
        EXPECT_NE(status.message().find(call), std::string::npos) << status.text();
        EXPECT_NE(status.message().find(name_of(error)), std::string::npos) << status.text();
        asked->expect_nothing();
    };
    ask_in_vain(successes);
    if (call == "vkAllocateMemory") {  // refused twice in a row
        ask_in_vain(0);
    }
    if (error == VK_ERROR_DEVICE_LOST) {
        asked->expect_to_be_lost();
    } else {
        asked->expect_to_work();
        asked->expect_an_answering_context();
    }
    asked->expect_to_leave_nothing();
}

std::vector<std::string_view> calls_of(const MakeDeviceWorld& make, DeviceWorld::Step step) {
    const auto asked = make();
    asked->ask_all_before(step);
    asked->driver().forget_calls();
    asked->expect_to_work();
    return asked->driver().calls();
}

std::uint64_t allocations_of(const MakeDeviceWorld& make, DeviceWorld::Step step) {
    const auto asked = make();
    asked->ask_all_before(step);
    const std::uint64_t before = test_support::allocation_count_of_this_thread();
    asked->expect_to_work();
    return test_support::allocation_count_of_this_thread() - before;
}

}  // namespace

DeviceWorld::DeviceWorld(std::uint32_t storage_range) {
    driver().set_storage_range(storage_range);
    life_.take_all_before(World::Step::submit_first);
    Expected<nearfield::World> world = nearfield::World::create(life_.context());
    EXPECT_TRUE(world.has_value()) << world.error().text();
    world_.emplace(std::move(*world));
    add(4, 3);
}

void DeviceWorld::add(int count, int corners) {
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

void DeviceWorld::prepare(Step step) {
    if (step == Step::moved) {
        EXPECT_TRUE(world_->move(instances_.front(), {{0.5, 0.5}, 1.0}).ok());
    } else if (step == Step::larger) {
        enlarge();
    }
}

void DeviceWorld::ask_all_before(Step step) {
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

void DeviceWorld::expect_to_work() {
    const Status status = ask();
    EXPECT_TRUE(status.ok()) << status.text();
}

void DeviceWorld::expect_an_answering_context() {
    driver().let_shaders_find({});
    std::vector<double> numbers;
    const Status status = life_.answer(numbers);
    EXPECT_TRUE(status.ok()) << status.text();
    static const std::vector<double> expected = numbers;
    EXPECT_EQ(numbers, expected);
}

void DeviceWorld::expect_to_be_lost() {
    EXPECT_EQ(ask().code(), StatusCode::device_lost);
    expect_nothing();
    EXPECT_EQ(driver().work_after_loss(), std::vector<std::string>{});
    Results results;
    EXPECT_EQ(life_.context().run(life_.batch(8), results).code(), StatusCode::device_lost);
}

void DeviceWorld::expect_to_leave_nothing() {
    forget();
    world_.reset();
    EXPECT_TRUE(life_.take(World::Step::destroy).ok());
    EXPECT_EQ(driver().alive(), std::vector<std::string>{});
    EXPECT_EQ(driver().breaches(), std::vector<std::string>{});
}

void expect_to_survive_failing_calls(
    const MakeDeviceWorld& make,
    const std::function<void(DeviceWorld::Step, std::map<std::string_view, std::size_t>&)>& check) {
    for (const DeviceWorld::Step step : DeviceWorld::steps) {
        std::map<std::string_view, std::size_t> count;
        for (const std::string_view call : calls_of(make, step)) {
            for (const VkResult error : errors_of(call)) {
                try_error(make, step, call, count[call], error);
                if (::testing::Test::HasFailure()) {
                    return;
                }
            }
            ++count[call];
        }
        check(step, count);
    }
}

void expect_to_survive_scarce_memory(const MakeDeviceWorld& make) {
    constexpr std::uint64_t max_tries = 50;  // of a step, spread over all of its allocations
    for (const DeviceWorld::Step step : DeviceWorld::steps) {
        const std::uint64_t stride = allocations_of(make, step) / max_tries + 1;
        bool has_failed = true;
        for (std::uint64_t successes = 0; has_failed; successes += stride) {
            SCOPED_TRACE(::testing::Message() << "step " << static_cast<int>(step)
                                              << ": memory for " << successes << " allocations");
            const auto asked = make();
            asked->ask_all_before(step);
            for (const bool is_again : {false, true}) {
                Status status;
                {
                    const FailingAllocations scarce(successes);
                    status = asked->ask();
                }
                const bool fails = FailingAllocations::has_failed();
                has_failed = is_again ? has_failed : fails;
                EXPECT_EQ(status.code(), fails ? StatusCode::out_of_memory : StatusCode::ok)
                    << status.text();
                if (fails) {
                    asked->expect_nothing();
                }
            }
            asked->expect_to_work();
            asked->expect_an_answering_context();
            asked->expect_to_leave_nothing();
            if (::testing::Test::HasFailure()) {
                return;
            }
        }
    }
}

}  // namespace nearfield::test
