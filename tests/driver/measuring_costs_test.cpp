#include <nearfield/diagnostics.hpp>

#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>

#include <set>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::MockDriver;
using test_support::name_of;

/// The calls that measuring costs makes as long as submissions succeed; the first ones have queries
/// of all kinds.
std::set<std::string_view> calls_of_measuring() {
    World world(Technique::raster);
    world.take_all_before(World::Step::submit_first);
    world.driver().forget_calls();
    world.driver().fail("vkQueueSubmit", 40, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                        MockDriver::Failing::once);
    EXPECT_EQ(measure_costs(world.context()).error().code(), StatusCode::out_of_memory);
    return {world.driver().calls().begin(), world.driver().calls().end()};
}

TEST(MeasuringCosts, NamesWhatFailsAndChangesNothing) {
    const std::vector<double> expected = World::undisturbed(Technique::raster);
    int tried = 0;
    for (const std::string_view call : calls_of_measuring()) {
        for (const VkResult error : errors_of(call)) {
            SCOPED_TRACE(::testing::Message() << call << " says " << name_of(error));
            World world(Technique::raster);
            world.take_all_before(World::Step::submit_first);
            world.driver().fail(call, 0, error, MockDriver::Failing::from_then_on);
            const Status status = measure_costs(world.context()).error();
            world.driver().work_again();
            ASSERT_TRUE(world.driver().has_failed());
            EXPECT_EQ(status.code(), code_of(error)) << status.text();
            EXPECT_NE(status.message().find(call), std::string::npos) << status.text();
            EXPECT_NE(status.message().find(name_of(error)), std::string::npos) << status.text();
            std::vector<double> numbers;
            const StatusCode next = world.answer(numbers).code();
            EXPECT_EQ(next,
                      error == VK_ERROR_DEVICE_LOST ? StatusCode::device_lost : StatusCode::ok);
            EXPECT_EQ(numbers, error == VK_ERROR_DEVICE_LOST ? std::vector<double>{} : expected);
            EXPECT_TRUE(world.take(World::Step::destroy).ok());
            EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
            EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
            ++tried;
        }
    }
    EXPECT_GT(tried, 20);
}

}  // namespace
}  // namespace nearfield::test
