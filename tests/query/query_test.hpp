#pragma once

#include <nearfield/nearfield.hpp>

#include <gtest/gtest.h>

#include <cstdint>

namespace nearfield::test {

/// Number of random cases a test tries: `usual`, or what the environment variable
/// NEARFIELD_TEST_CASES says.
int random_cases(int usual);

/// Tests that share one context on one bare, validated host device. A test fails where the
/// validation layers had something to say.
class QueryTest : public testing::Test {
protected:
    void SetUp() override;
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
