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

TEST(MemoryBudget, WhoNeedsTooMuchIsToldTheToleranceThatFits) {
    const QueryLimits limits = limits_with(1U << 28U);
    const double room = 0.75 * std::ldexp(1.0, 28);
    for (const double growth : {1.0, 2.0}) {
        MemoryBudget budget(limits);
        QueryMemory query(budget, 7, 0.5);
        try {
            query.require(room * 16.0, growth);
            ADD_FAILURE() << "nothing thrown";
        } catch (const StatusException& failure) {
            const std::string message = failure.status().message();
            const auto at = message.find("about ");
            ASSERT_NE(at, std::string::npos) << message;
            const double told = std::stod(message.substr(at + 6));
            EXPECT_GT(told, 0.9 * 0.5 * std::pow(16.0, 1.0 / growth));
            EXPECT_LT(told, 1.1 * 0.5 * std::pow(16.0, 1.0 / growth));
            EXPECT_EQ(message.find("query 7 with tolerance 0.5"), 0U) << message;
        }
    }
    // Several queries that fit one by one.
    MemoryBudget budget(limits);
    QueryMemory(budget, 0, 0.5).require(0.9 * room, 2.0);
    try {
        QueryMemory(budget, 1, 0.5).require(0.9 * room, 2.0);
        ADD_FAILURE() << "nothing thrown";
    } catch (const StatusException& failure) {
        EXPECT_NE(failure.status().message().find("the batch is too large"), std::string::npos);
    }
}

}  // namespace
}  // namespace nearfield::queries
