#include "shape_samples.hpp"

#include <engine/exact/placed_edges.hpp>
#include <engine/exact/stretches.hpp>
#include <engine/geometry/segment.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace nearfield::exact {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// Calls `check(stretches)` with what is found of an edge in either way.
template <class Check>
void find_both_ways(const PlacedEdges& a, std::uint32_t edge, const PlacedEdges& b, double reach,
                    const Check& check) {
    std::vector<Stretch> found(most_stretches);
    const auto first = [&](std::uint32_t count) {
        return std::vector<Stretch>(found.begin(), found.begin() + count);
    };
    check(first(kernels::find_stretches_near(a, edge, b, reach, found.data())));
    check(first(kernels::find_stretches_near(a, edge, b.tree(), reach, found.data())));
}

TEST(Stretches, HoldWhatIsNearAndHardlyMore) {
    samples::Random random(61);
    std::size_t near_places = 0;
    std::size_t parts = 0;
    for (int i = 0; i < 100; ++i) {
        const Polygon a = samples::polygon({samples::star(random, 9, 0.3, 1.0)});
        const Polygon b =
            samples::polygon({samples::star(random, 3 + random.below(300), 0.5, 0.9)});
        PlacedInstances instances;
        const std::uint32_t index_a =
            instances.place(a, {{random.between(-1.0, 1.0), random.between(-1.0, 1.0)}, 0.4});
        const std::uint32_t index_b = instances.place(b, {});
        instances.complete(index_b);
        const PlacedEdges& edges = instances[index_a];
        const PlacedEdges& others = instances[index_b];
        for (const double reach : {1e-3, 0.05, 0.5}) {
            for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
                find_both_ways(edges, edge, others, reach, [&](const std::vector<Stretch>& found) {
                    parts += found.size() == 1 && found[0].to - found[0].from < 1.0 ? 1U : 0U;
                    const bool all_told = found.size() < most_stretches;
                    for (double at = 0.0; at <= 1.0; at += 1.0 / 64.0) {
                        const Vector start = edges.start(edge);
                        const Vector point = start + at * (edges.end(edge) - start);
                        const double squared = find_nearest(others, point).squared;
                        const bool is_in =
                            std::any_of(found.begin(), found.end(), [at](const Stretch& stretch) {
                                return stretch.from <= at && at <= stretch.to;
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
    // A long edge above the tips of a comb, every tip a stretch of its own.
    const auto found_above = [](std::uint32_t teeth) {
        const Polygon a = samples::polygon({{{-1.0, 1.001}, {1.0, 1.001}, {0.0, 2.0}}});
        const Polygon b = samples::polygon({samples::comb(teeth)});
        PlacedInstances instances;
        const std::uint32_t index_a = instances.place(a, {});
        const std::uint32_t index_b = instances.place(b, {});
        instances.complete(index_b);
        std::vector<std::size_t> counts;
        find_both_ways(instances[index_a], 0, instances[index_b], 0.002,
                       [&](const std::vector<Stretch>& found) { counts.push_back(found.size()); });
        return counts;
    };
    EXPECT_EQ(found_above(most_stretches), std::vector<std::size_t>(2, most_stretches));
    EXPECT_EQ(found_above(most_stretches + 1), std::vector<std::size_t>(2, 1));
}

}  // namespace
}  // namespace nearfield::exact
