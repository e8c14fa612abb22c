#include <engine/base/status_exception.hpp>
#include <engine/queries/memory_budget.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace nearfield::queries {
namespace {

QueryLimits limits_with(std::uint64_t memory) {
    QueryLimits limits;
    limits.memory = memory;
    return with_affordable_atlas(limits);
}

TEST(MemoryBudget, ImagesTakeAtMostAQuarterOfTheMemory) {
    constexpr std::uint64_t mebibyte = 1U << 20U;
    EXPECT_EQ(limits_with(4096 * mebibyte).largest_atlas, largest_atlas_side);
    EXPECT_EQ(limits_with(1).largest_atlas, smallest_atlas);
    for (std::uint64_t memory = 16 * mebibyte; memory <= 4096 * mebibyte; memory *= 2) {
        const QueryLimits limits = limits_with(memory);
        EXPECT_LE(limits.largest_tile, limits.largest_atlas);
        // Three quarters are left to results, but never all of it.
        MemoryBudget budget(limits);
        QueryMemory query(budget, 0, 1.0);
        query.require(0.75 * static_cast<double>(memory), 1.0);
        EXPECT_THROW(query.require(0.25 * static_cast<double>(memory), 1.0), StatusException);
    }
}

TEST(MemoryBudget, PointsOfAQueryAreCountedCloselyOnlyIfTheyAreMany) {
    MemoryBudget budget(limits_with(1U << 28U));
    QueryMemory query(budget, 3, 0.5);
    const auto never = []() -> double {
        ADD_FAILURE() << "counted";
        return 0.0;
    };
    query.require_alone(100.0, 1e6, never);
    query.require_alone(0.0, 1e9, never);
    query.require_alone(100.0, 1e9, [] { return 1e6; });
    EXPECT_THROW(query.require_alone(100.0, 1e9, [] { return 1e8; }), StatusException);
    EXPECT_EQ(budget.result_bytes(), 0.0) << "nothing is added";
    try {
        query.require_alone(0.0, 1e12, [] { return 1e11; });
        ADD_FAILURE() << "nothing thrown";
    } catch (const StatusException& failure) {
        const std::string message = failure.status().message();
        const auto at = message.find("about ");
        ASSERT_NE(at, std::string::npos) << message;
        EXPECT_NEAR(std::stod(message.substr(at + 6)), 1.05 * 0.5 * 1e11 / std::ldexp(1.0, 30),
                    1.0);
    }
}

}  // namespace
}  // namespace nearfield::queries
