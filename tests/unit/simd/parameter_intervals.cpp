#include <engine/geometry/segment.hpp>
#include <engine/simd/parameter_intervals.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <vector>

namespace nearfield::simd {
namespace {

using geometry::Polygon;
using geometry::Vector;

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

TEST(Stretches, HoldWhatIsNearAndHardlyMore) {
    samples::Random random(61);
    std::size_t near_places = 0;
    std::size_t parts = 0;
    for (int i = 0; i < 100; ++i) {
        const Polygon a = samples::polygon({samples::star(random, 9, 0.3, 1.0)});
        const Polygon b =
            samples::polygon({samples::star(random, 3 + random.below(300), 0.5, 0.9)});
        TransformedInstances instances;
        const std::uint32_t index_a =
            instances.place(a, {{random.between(-1.0, 1.0), random.between(-1.0, 1.0)}, 0.4});
        const std::uint32_t index_b = instances.place(b, {});
        instances.complete(index_b);
        const TransformedEdges& edges = instances[index_a];
        const TransformedEdges& others = instances[index_b];
        for (const double reach : {1e-3, 0.05, 0.5}) {
            for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
                find_both_ways(
                    edges, edge, others, reach, [&](const std::vector<ParameterInterval>& found) {
                        parts += found.size() == 1 && found[0].to - found[0].from < 1.0 ? 1U : 0U;
                        const bool all_told = found.size() < simd::max_intervals;
                        for (double at = 0.0; at <= 1.0; at += 1.0 / 64.0) {
                            const Vector start = edges.start(edge);
                            const Vector point = start + at * (edges.end(edge) - start);
                            const double squared = simd::find_nearest(others, point).squared;
                            const bool is_in =
                                std::any_of(found.begin(), found.end(),
                                            [at](const ParameterInterval& interval) {
                                                return interval.from <= at && at <= interval.to;
                                            });
                            const bool is_near = squared < 0.999 * reach * reach;
                            near_places += is_near ? 1U : 0U;
                            EXPECT_TRUE(is_in || !is_near) << "at " << at << " of " << edge;
                            EXPECT_TRUE(!is_in || !all_told || squared < 2.25 * reach * reach)
                                << "at " << at << " of " << edge;
                        }
                    });
            }
        }
    }
    EXPECT_GT(near_places, 100000U);
    EXPECT_GT(parts, 1000U);
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
