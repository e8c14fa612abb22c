#include <gtest/gtest.h>
#include <tools/benchmark/measuring.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace nearfield::benchmark {
namespace {

TEST(Spread, OfOneMeasurementIsThatOne) {
    const Spread spread = spread_of({3.0});
    EXPECT_EQ(spread.least, 3.0);
    EXPECT_EQ(spread.lower_quartile, 3.0);
    EXPECT_EQ(spread.median, 3.0);
    EXPECT_EQ(spread.upper_quartile, 3.0);
    EXPECT_EQ(spread.count, 1U);
}

TEST(Spread, QuartilesLieBetweenMeasurementsInAnyOrder) {
    const Spread spread = spread_of({4.0, 1.0, 3.0, 2.0});
    EXPECT_DOUBLE_EQ(spread.least, 1.0);
    EXPECT_DOUBLE_EQ(spread.lower_quartile, 1.75);
    EXPECT_DOUBLE_EQ(spread.median, 2.5);
    EXPECT_DOUBLE_EQ(spread.upper_quartile, 3.25);
    EXPECT_EQ(spread.count, 4U);
}

TEST(MedianTimings, AreThoseOfTheMeasuredFrames) {
    std::vector<Timings> frames(5);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double milliseconds = i < 2 ? 100.0 : static_cast<double>(i);
        frames[i].total = milliseconds;
        frames[i].passes.push_back({"fill", 2.0 * milliseconds});
    }
    const Timings median = median_timings(frames, 3);
    EXPECT_EQ(median.total, 3.0);
    ASSERT_EQ(median.passes.size(), 1U);
    EXPECT_EQ(median.passes[0].name, "fill");
    EXPECT_EQ(median.passes[0].milliseconds, 6.0);
}

/// A contender whose frames report this time and write its letter to a log.
Contender fake(std::string& log, char letter, double milliseconds) {
    return {[&log, letter, milliseconds] {
                log.push_back(letter);
                return milliseconds;
            },
            {}};
}

TEST(Measure, TakesTurnsUntilEachHasHadItsTime) {
    std::string log;
    std::vector<Contender> contenders{fake(log, 'a', 10.0), fake(log, 'b', 20.0)};
    measure(contenders, {.milliseconds = 60.0, .turn = 20.0});
    // Warm-up until more than a turn has passed: three of a, two of b; then alternating turns.
    EXPECT_EQ(log, std::string("aaabb") + "aab" + "baa" + "aab");
    EXPECT_EQ(contenders[0].frames_ms, std::vector<double>(6, 10.0));
    EXPECT_EQ(contenders[1].frames_ms, std::vector<double>(3, 20.0));
}

TEST(Measure, ASlowOneHasItsFewestFramesAndAQuickOneItsMost) {
    std::string log;
    std::vector<Contender> contenders{fake(log, 'a', 1000.0), fake(log, 'b', 0.001)};
    measure(contenders, {.milliseconds = 60.0, .max_frames = 50, .fewest_frames = 3});
    EXPECT_EQ(contenders[0].frames_ms.size(), 3U);
    EXPECT_EQ(contenders[1].frames_ms.size(), 50U);
}

}  // namespace
}  // namespace nearfield::benchmark
