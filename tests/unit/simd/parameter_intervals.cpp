#include <engine/simd/parameter_intervals.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <vector>

namespace nearfield::simd {
namespace {

using geometry::Polygon;

/// Calls `check(intervals)` with the parameter intervals of an edge, found by both overloads.
template <class Check>
void find_both_ways(const TransformedEdges& a, std::uint32_t edge, const TransformedEdges& b,
                    double reach, const Check& check) {
    std::vector<ParameterInterval> found(simd::max_intervals);
    const auto first = [&](std::uint32_t count) {
        return std::vector<ParameterInterval>(found.begin(), found.begin() + count);
    };
    check(first(kernels::find_intervals_near(a, edge, b, reach, found.data())));
    VisitsLeft unlimited;
    check(first(kernels::find_intervals_near(a, edge, b.tree(), reach, unlimited, found.data())));
}

TEST(Stretches, TooManyAreTheWholeEdge) {
    // A long edge above the tips of a comb, with a separate interval for every tip.
    const auto found_above = [](std::uint32_t teeth) {
        const Polygon a = samples::polygon({{{-1.0, 1.001}, {1.0, 1.001}, {0.0, 2.0}}});
        const Polygon b = samples::polygon({samples::comb(teeth)});
        TransformedInstances instances;
        const std::uint32_t index_a = instances.place(a, {});
        const std::uint32_t index_b = instances.place(b, {});
        instances.complete(index_b);
        std::vector<std::size_t> counts;
        find_both_ways(
            instances[index_a], 0, instances[index_b], 0.002,
            [&](const std::vector<ParameterInterval>& found) { counts.push_back(found.size()); });
        return counts;
    };
    EXPECT_EQ(found_above(simd::max_intervals), std::vector<std::size_t>(2, simd::max_intervals));
    EXPECT_EQ(found_above(simd::max_intervals + 1), std::vector<std::size_t>(2, 1));
}

}  // namespace
}  // namespace nearfield::simd
