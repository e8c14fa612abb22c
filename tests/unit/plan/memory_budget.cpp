#include <engine/base/status_exception.hpp>
#include <engine/plan/memory_budget.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace nearfield::plan {
namespace {

PlanLimits limits_with(std::uint64_t memory) {
    PlanLimits limits;
    limits.memory = memory;
    return with_affordable_atlas(limits);
}

TEST(MemoryBudget, ImagesTakeAtMostAQuarterOfTheMemory) {
    constexpr std::uint64_t mebibyte = 1U << 20U;
    EXPECT_EQ(limits_with(4096 * mebibyte).largest_atlas, largest_atlas_side);
    EXPECT_EQ(limits_with(1).largest_atlas, smallest_atlas);
    for (std::uint64_t memory = 16 * mebibyte; memory <= 4096 * mebibyte; memory *= 2) {
        const PlanLimits limits = limits_with(memory);
        EXPECT_LE(limits.largest_tile, limits.largest_atlas);
        // Three quarters are left to results, but never all of it.
        MemoryBudget budget(limits, false);
        QueryMemory query(budget, 0, 1.0);
        query.require(0.75 * static_cast<double>(memory), 1.0);
        EXPECT_THROW(query.require(0.25 * static_cast<double>(memory), 1.0), StatusException);
    }
}

TEST(MemoryBudget, TheLargestQueryDecidesHowManyJobsHaveRoom) {
    const PlanLimits limits = limits_with(1U << 28U);
    const auto jobs_after = [&](double first, double second) {
        MemoryBudget budget(limits, false);
        EXPECT_TRUE(QueryMemory(budget, 0, 1.0).fits_roughly(first, 0.0));
        EXPECT_TRUE(QueryMemory(budget, 1, 1.0).fits_roughly(second, 0.0));
        return budget.jobs_with_room();
    };
    EXPECT_EQ(jobs_after(50'000.0, 1.0), jobs_after(1.0, 50'000.0));
    EXPECT_LT(jobs_after(50'000.0, 1.0), jobs_after(1.0, 1.0));
}

TEST(MemoryBudget, RecordsAreEstimatedRoughlyUnlessTheyAreCountedClosely) {
    const PlanLimits limits = limits_with(1U << 28U);
    MemoryBudget roughly(limits, false);
    QueryMemory query(roughly, 0, 1.0);
    EXPECT_TRUE(query.fits_roughly(1000.0, 1e9));
    EXPECT_EQ(roughly.result_bytes(), 1e9);
    EXPECT_TRUE(roughly.is_exceeded());
    MemoryBudget closely(limits, true);
    QueryMemory again(closely, 0, 1.0);
    EXPECT_FALSE(again.fits_roughly(1000.0, 1e9));
    EXPECT_TRUE(again.fits_roughly(1000.0, 0.0)) << "without records there is nothing to count";
    EXPECT_TRUE(again.fits(10.0, 1e7));
    EXPECT_EQ(closely.result_bytes(), 1e7);
    EXPECT_FALSE(closely.is_exceeded());
    EXPECT_THROW(static_cast<void>(again.fits(1000.0, 1e9)), StatusException);
}

TEST(MemoryBudget, WhoNeedsTooMuchIsToldTheToleranceThatFits) {
    const PlanLimits limits = limits_with(1U << 28U);
    const double room = 0.75 * std::ldexp(1.0, 28);
    for (const double growth : {1.0, 2.0}) {
        MemoryBudget budget(limits, false);
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
    MemoryBudget budget(limits, false);
    QueryMemory(budget, 0, 0.5).require(0.9 * room, 2.0);
    try {
        QueryMemory(budget, 1, 0.5).require(0.9 * room, 2.0);
        ADD_FAILURE() << "nothing thrown";
    } catch (const StatusException& failure) {
        EXPECT_NE(failure.status().message().find("the batch is too large"), std::string::npos);
    }
}

}  // namespace
}  // namespace nearfield::plan
