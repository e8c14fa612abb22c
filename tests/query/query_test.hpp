#pragma once

#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>
#include <tests/support/random_cases.hpp>
#include <tests/support/techniques.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nearfield::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr std::array every_kind{IntersectionKind::boundary_boundary,
                                       IntersectionKind::boundary_volume,
                                       IntersectionKind::volume_volume};
inline constexpr std::array every_strategy{
    IntersectionStrategy::stencil, IntersectionStrategy::blend, IntersectionStrategy::logic_op,
    IntersectionStrategy::depth};
inline constexpr std::array both_ways{PenetrationPoints::boundary, PenetrationPoints::vertices};

/// Fails the test for each query that was not answered.
void expect_answers(const Results& results);

/// The box around the samples, of which there is at least one.
[[nodiscard]] Rectangle box_of(const std::vector<IntersectionSample>& samples);

/// Settings with which no pipeline is made that a test does not need.
[[nodiscard]] Settings on_demand(Settings settings = {});

/// The query, by the raster where there is one.
template <class Query>
[[nodiscard]] Query drawn(Query query) {
    query.technique = device_techniques.front();
    return query;
}

/// Tests that share one context on one bare, validated host device. A test fails if the validation
/// layers report anything.
class QueryTest : public testing::Test {
protected:
    void TearDown() override;

    [[nodiscard]] static Context& context();
    /// The device of context(), for a second context.
    [[nodiscard]] static const HostDevice& host_device();
};

/// Runs a batch of one query. If the whole batch fails, the result contains its status.
template <class Query>
typename Query::Result run_alone(Context& context, const Query& query) {
    Batch batch;
    Results results;
    const auto handle = batch.add(query);
    const Status status = context.run(batch, results);
    if (!status.ok()) {
        typename Query::Result failed;
        failed.status = status;
        return failed;
    }
    return results[handle];
}

}  // namespace nearfield::test
