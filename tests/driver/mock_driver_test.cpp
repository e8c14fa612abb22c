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
            const bool is_new = step == World::Step::submit_first ||
                                step == World::Step::submit_larger ||
                                step == World::Step::record_last;
            const bool asks_for_normals = step == World::Step::collect_first;
            const bool has_more_room = step == World::Step::record;  // for all samples
            EXPECT_EQ(asks("vkCreateBuffer"), is_new || asks_for_normals || has_more_room);
            EXPECT_EQ(asks("vkCreateImage"),
                      is_new || (asks_for_normals && technique == Technique::raster));
            const bool submits =
                step == World::Step::submit_first || step == World::Step::collect_first ||
                step == World::Step::submit_larger || step == World::Step::collect_larger ||
                step == World::Step::submit_without_work || step == World::Step::submit_last;
            EXPECT_EQ(asks("vkQueueSubmit"), submits)
                << "gradient normals are to be asked for when a batch is collected, and what is "
                   "recorded is the host's to submit";
            EXPECT_TRUE(step >= World::Step::submit_first && step < World::Step::submit_without_work
                            ? world.is_after_first()
                            : world.is_before_first());
            world.driver().forget_calls();
        }
    }
}

}  // namespace
}  // namespace nearfield::test
