#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>
#include <tests/support/shader_folder.hpp>

#include <map>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::MockDriver;
using test_support::name_of;
using test_support::ShaderFolder;

/// The calls that take other shaders into use, by how often they are made.
std::map<std::string_view, std::size_t> calls_of_reloading(const ShaderFolder& folder) {
    World world(Technique::compute);
    world.take_all_before(World::Step::submit_first);
    world.driver().forget_calls();
    EXPECT_EQ(world.context().reload_shaders(folder.path().c_str()).value(), 1U);
    std::map<std::string_view, std::size_t> count;
    for (const std::string_view call : world.driver().calls()) {
        ++count[call];
    }
    EXPECT_EQ(count.count("vkWaitForFences"), 0U);
    return count;
}

/// What a driver refuses leaves the pipelines there were, and can be asked for again.
TEST(ReloadedShaders, ThatTheDriverRefusesAreNamedAndLeaveThoseThereWere) {
    ShaderFolder folder;
    folder.replace("collect_masks.comp", "void main() {", "void main() {\n    return;");
    const std::vector<double> expected = World::undisturbed(Technique::compute);
    for (const auto& [call, count] : calls_of_reloading(folder)) {
        const std::vector<VkResult>& errors = errors_of(call);
        if (errors.empty()) {
            continue;
        }
        SCOPED_TRACE(::testing::Message() << "the last " << call << " says " << name_of(errors[0]));
        World world(Technique::compute);
        world.take_all_before(World::Step::submit_first);
        world.driver().fail(call, count - 1, errors[0], MockDriver::Failing::once);
        const Expected<std::uint32_t> changed =
            world.context().reload_shaders(folder.path().c_str());
        ASSERT_TRUE(world.driver().has_failed());
        EXPECT_EQ(changed.status().code(), code_of(errors[0]));
        EXPECT_NE(changed.status().text().find(call), std::string::npos) << changed.status().text();
        std::vector<double> numbers;
        EXPECT_TRUE(world.answer(numbers).ok());
        EXPECT_EQ(numbers, expected);
        EXPECT_TRUE(world.take(World::Step::destroy).ok());
        EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
    }
}

TEST(ReloadedShaders, WaitForBatchesInFlightToBeCollected) {
    const ShaderFolder folder;
    World world(Technique::compute);
    world.take_all_before(World::Step::submit_first);
    const Expected<Ticket> ticket = world.context().submit(world.overlap(8));
    ASSERT_TRUE(ticket.ok());
    const Status status = world.context().reload_shaders(folder.path().c_str()).status();
    EXPECT_EQ(status.code(), StatusCode::not_ready) << status.text();
    Results results;
    EXPECT_TRUE(world.context().collect(*ticket, results).ok());
    EXPECT_TRUE(world.context().reload_shaders(folder.path().c_str()).ok());
    // Its ticket stays used, whatever was made anew.
    EXPECT_EQ(world.context().collect(*ticket, results).code(), StatusCode::unknown_ticket);
}

}  // namespace
}  // namespace nearfield::test
