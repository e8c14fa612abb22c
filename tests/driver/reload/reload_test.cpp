#include <nearfield/diagnostics.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>

#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>
#include <tests/support/pair_tables.hpp>
#include <tests/support/shader_folder.hpp>

#include <map>

namespace nearfield::test {
namespace {

using test_support::errors_of;
using test_support::MockDriver;
using test_support::name_of;
using test_support::ShaderFolder;

/// A context that has compiled all shaders of a folder, which are those it was built with.
class ReloadedShaders : public ::testing::Test {
protected:
    ReloadedShaders() {
        world_.take_all_before(World::Step::submit_first);
        EXPECT_EQ(*reload(), 0U);
    }
    ~ReloadedShaders() override {
        EXPECT_TRUE(world_.take(World::Step::destroy).ok());
        EXPECT_EQ(driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(driver().breaches(), std::vector<std::string>{});
    }

    [[nodiscard]] MockDriver& driver() { return world_.driver(); }
    [[nodiscard]] Expected<std::uint32_t> reload() {
        return reload_shaders(world_.context(), folder_.path().c_str());
    }
    void change() {
        folder_.replace("collect_masks.comp", "void main() {", "void main() {\n    return;");
    }
    /// The calls that replace a shader, with how often they are made.
    std::map<std::string_view, std::size_t> calls_of_reloading() {
        change();
        driver().forget_calls();
        EXPECT_EQ(*reload(), 1U);
        std::map<std::string_view, std::size_t> count;
        for (const std::string_view call : driver().calls()) {
            ++count[call];
        }
        folder_.restore("collect_masks.comp");
        EXPECT_EQ(*reload(), 1U);
        return count;
    }

    ShaderFolder folder_;
    World world_{Technique::compute};
};

/// If the driver refuses a shader, the previous pipelines stay, and the reload can be repeated.
TEST_F(ReloadedShaders, ThatTheDriverRefusesAreNamedAndLeaveThoseThereWere) {
    const auto calls = calls_of_reloading();
    EXPECT_FALSE(calls.contains("vkWaitForFences"));
    EXPECT_TRUE(calls.contains("vkCreateShaderModule"));
    std::vector<double> expected;
    ASSERT_TRUE(world_.answer(expected).ok());
    change();
    for (const auto& [call, count] : calls) {
        const std::vector<VkResult>& errors = errors_of(call);
        if (errors.empty()) {
            continue;
        }
        SCOPED_TRACE(::testing::Message() << "the last " << call << " says " << name_of(errors[0]));
        driver().fail(call, count - 1, errors[0], MockDriver::Failing::once);
        const Status status = reload().error();
        ASSERT_TRUE(driver().has_failed());
        EXPECT_EQ(status.code(), code_of(errors[0]));
        EXPECT_NE(status.text().find(call), std::string::npos) << status.text();
        std::vector<double> numbers;
        EXPECT_TRUE(world_.answer(numbers).ok());
        EXPECT_EQ(numbers, expected);
    }
    EXPECT_EQ(*reload(), 1U);
}

TEST_F(ReloadedShaders, WaitForBatchesInFlightToBeCollected) {
    const Expected<Ticket> ticket = world_.context().submit(world_.overlap(8));
    ASSERT_TRUE(ticket.has_value());
    const Status status = reload().error();
    EXPECT_EQ(status.code(), StatusCode::not_ready) << status.text();
    Results results;
    EXPECT_TRUE(world_.context().collect(*ticket, results).ok());
    change();
    EXPECT_EQ(*reload(), 1U);
    // Its ticket stays used, whatever was recreated.
    EXPECT_EQ(world_.context().collect(*ticket, results).code(), StatusCode::unknown_ticket);
}

TEST_F(ReloadedShaders, WaitForTablesOfPairsInFlightToBeCollected) {
    nearfield::World world = *nearfield::World::create(world_.context());
    PairTable<PenetrationQuery> table({.tolerance = 0.1}, on_device);
    ASSERT_TRUE(world.submit(table).ok());
    const Status status = reload().error();
    EXPECT_EQ(status.code(), StatusCode::not_ready) << status.text();
    EXPECT_TRUE(table.collect().ok());
    change();
    EXPECT_EQ(*reload(), 1U);
    ASSERT_TRUE(world.submit(table).ok());
    table = PairTable<PenetrationQuery>({.tolerance = 0.1}, on_device);
    folder_.restore("collect_masks.comp");
    EXPECT_EQ(*reload(), 1U);
}

}  // namespace
}  // namespace nearfield::test
