#pragma once

#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <cstdint>
#include <string>

namespace nearfield::test {

/// Number of random cases a test tries: `usual`, or what the environment variable
/// NEARFIELD_TEST_CASES says.
int random_cases(int usual);
/// 0, or what the environment variable NEARFIELD_TEST_FIRST says.
int first_case();

/// Calls `check(random)` once a case, each with a source of numbers of its own. The seed and the
/// case stand in the trace of a failure; the environment variable NEARFIELD_TEST_FIRST names the
/// case to begin with.
template <class Check>
void for_each_case(std::uint64_t seed, int usual, const Check& check) {
    const int first = first_case();
    const int cases = random_cases(usual);
    for (int i = first; i < first + cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " case " + std::to_string(i));
        Random random(seed + static_cast<std::uint64_t>(i));
        check(random);
    }
}

/// Settings with which Technique::automatic draws whatever can be drawn, so that a query that says
/// nothing tests the raster.
[[nodiscard]] Settings drawing(Settings settings = {});

/// Tests that share one context on one bare, validated host device. A test fails where the
/// validation layers had something to say.
class QueryTest : public testing::Test {
protected:
    void TearDown() override;

    [[nodiscard]] static Context& context();
    /// The device that context() stands on, for a second context.
    [[nodiscard]] static const HostDevice& host_device();
};

/// Runs a batch of one query. Where the whole batch fails, its status stands in the result.
template <class Query>
typename ResultOf<Query>::type run_alone(Context& context, const Query& query) {
    Batch batch;
    Results results;
    const auto handle = batch.add(query);
    const Status status = context.run(batch, results);
    if (!status.ok()) {
        typename ResultOf<Query>::type failed;
        failed.status = status;
        return failed;
    }
    return results[handle];
}

}  // namespace nearfield::test
