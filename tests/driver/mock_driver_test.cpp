#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/mock_driver.hpp>

#include <algorithm>
#include <set>

namespace nearfield::test {
namespace {

using test_support::MockDriver;

constexpr Technique techniques[] = {Technique::raster, Technique::compute};

TEST(MockDriver, HasNothingToComplainOfALifeWithoutFailures) {
    for (const Technique technique : techniques) {
        World world(technique);
        for (const World::Step step : World::steps) {
            SCOPED_TRACE(to_string(step));
            const Status status = world.take(step);
            ASSERT_TRUE(status.ok()) << status.text();
            EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
            EXPECT_EQ(world.driver().alive().empty(), step == World::Step::destroy);
            const auto& calls = world.driver().calls();
            const auto asks = [&](std::string_view call) {
                return std::find(calls.begin(), calls.end(), call) != calls.end();
            };
            EXPECT_EQ(asks("vkCreateBuffer"), step == World::Step::submit_first ||
                                                  step == World::Step::collect_first ||
                                                  step == World::Step::submit_larger);
            EXPECT_EQ(asks("vkCreateImage"),
                      technique == Technique::raster && (step == World::Step::submit_first ||
                                                         step == World::Step::collect_first ||
                                                         step == World::Step::submit_larger));
            EXPECT_EQ(asks("vkQueueSubmit"),
                      step >= World::Step::submit_first && step != World::Step::destroy)
                << "gradient normals are to be asked for when a batch is collected";
            world.driver().forget_calls();
        }
    }
}

}  // namespace
}  // namespace nearfield::test
