#include <engine/geometry/overlap.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::geometry {
namespace {

using ChainFinder = Effort (*)(const TransformedPolygon&, const TransformedPolygon&,
                               const OverlapOptions&, std::vector<Chain>&);

/// The edges that the chains cover. Checks the form of the chains: ring by ring, with boxes around
/// them, no edge twice, no two neighbours.
std::vector<bool> covered_edges(const TransformedPolygon& a, const std::vector<Chain>& chains,
                                const std::string& what) {
    const Polygon& polygon = a.polygon();
    std::vector<bool> covered(polygon.size(), false);
    std::vector<bool> ends(polygon.size(), false);
    for (std::size_t c = 0; c < chains.size(); ++c) {
        const Chain& chain = chains[c];
        EXPECT_TRUE(c == 0 || chains[c - 1].ring <= chain.ring) << what;
        EXPECT_GE(chain.count, 1U) << what;
        EXPECT_EQ(polygon.ring_of(chain.first), chain.ring) << what;
        std::uint32_t edge = chain.first;
        for (std::uint32_t i = 0; i < chain.count; ++i, edge = polygon.next(edge)) {
            EXPECT_FALSE(covered[edge]) << what << ": edge " << edge << " twice";
            covered[edge] = true;
        }
        const std::uint32_t size = polygon.ring_end(chain.ring) - polygon.ring_begin(chain.ring);
        ends[edge] = chain.count < size;
        const Box box = a.chain_box(chain.ring, chain.first, chain.count);
        EXPECT_EQ(chain.box.min(), box.min()) << what;
        EXPECT_EQ(chain.box.max(), box.max()) << what;
    }
    for (const Chain& chain : chains) {
        EXPECT_FALSE(ends[chain.first]) << what << ": neighbours at edge " << chain.first;
    }
    return covered;
}

/// With single edges as leaves, an edge is near exactly if its box overlaps that of an edge.
TEST(Chains, FullHeightComparesSingleEdges) {
    test::Random random(3);
    for (int round = 0; round < 20; ++round) {
        const Polygon polygon_a = samples::polygon(test::coast(random, 200, 0.5));
        const Polygon polygon_b = samples::polygon(
            {test::coast(random, 150, 0.5).front(),
             test::scaled_and_moved(test::star(random, 30, 0.3), 0.3, {}).front()});
        const TransformedPolygon a(polygon_a, {{random.between(0.0, 2.0), 0.0}, 1.0 * round});
        const TransformedPolygon b(polygon_b, {});
        const double grow = 0.01 * (round % 4);
        std::vector<Chain> chains;
        chains_near_boundary(a, b, {32, grow}, chains);
        const std::vector<bool> covered = covered_edges(a, chains, "full height");
        for (std::uint32_t i = 0; i < polygon_a.size(); ++i) {
            Box box = a.chain_box(0, i, 1);
            box = Box(box.min() - Vector(grow, grow), box.max() + Vector(grow, grow));
            bool meets = false;
            for (std::uint32_t j = 0; j < polygon_b.size(); ++j) {
                meets = meets || box.intersects(b.chain_box(polygon_b.ring_of(j), j, 1));
            }
            EXPECT_EQ(covered[i], meets) << "round " << round << ", edge " << i;
        }
    }
}

TEST(Chains, ASmallContactOpensFewNodes) {
    // Two smooth rings that overlap a little: complete trees would have 8191 nodes each.
    test::Random random(5);
    const Polygon polygon = samples::polygon(test::regular(4096));
    const TransformedPolygon a(polygon, {});
    const TransformedPolygon b(polygon, {{1.999, 0.0}, 0.3});
    std::vector<Chain> chains;
    const Effort effort = chains_in_volume(a, b, {12, 0.0}, chains);
    EXPECT_LT(effort.nodes_evaluated, 600U);
    std::uint32_t kept = 0;
    for (const Chain& chain : chains) {
        kept += chain.count;
    }
    EXPECT_GT(kept, 0U);
    EXPECT_LT(kept, 120U);
}

TEST(Chains, OfManyRingsAgainstManyAreFoundByOneSweep) {
    // Testing each ring against all of B would take seconds instead of milliseconds.
    constexpr int side = 100;
    test::Rings rings;
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side; ++y) {
            const Vector2 low{1.0 * x, 1.0 * y};
            rings.push_back(test::rectangle(low, {low.x + 0.4, low.y + 0.4}).front());
        }
    }
    const Polygon grid = samples::polygon(rings);
    const TransformedPolygon a(grid, {});
    // Moved into the gaps: all boxes of many rings overlap, no rings do.
    const TransformedPolygon beside(grid, {{0.5, 0.5}, 0.0});
    std::vector<Chain> chains;
    chains_in_volume(a, beside, {8, 0.0}, chains);
    EXPECT_TRUE(chains.empty());
}

TEST(Chains, EntangledBoundariesStayLawfulAndAffordable) {
    // Every tooth crosses every tooth: nothing can be excluded at any height.
    const Polygon polygon = samples::polygon({samples::comb(700)});
    const TransformedPolygon a(polygon, {});
    const TransformedPolygon b(polygon, {{0.0, 0.0}, 0.5 * std::numbers::pi});
    for (const ChainFinder find : {chains_in_volume, chains_near_boundary}) {
        std::vector<Chain> chains;
        const Effort effort = find(a, b, {30, 0.0}, chains);
        EXPECT_LE(effort.nodes_evaluated, 4U * polygon.size());
        EXPECT_LE(effort.pairs_rejected, 8U << 18U);
        const std::vector<bool> covered = covered_edges(a, chains, "combs");
        for (std::uint32_t i = 2; i + 1 < polygon.size(); ++i) {
            const double run = (a.vertex(i) - a.vertex(i + 1)).norm();
            EXPECT_TRUE(covered[i] || run < 1.0) << "the long edge " << i << " of a tooth";
        }
    }
}

TEST(JoinBoxes, ResultIsDisjointAndCovers) {
    test::Random random(6);
    for (int round = 0; round < 60; ++round) {
        const double size = std::pow(10.0, random.between(-4.0, -0.5));
        const double far = round % 2 == 0 ? 0.0 : 1e6;
        std::vector<Box> given;
        for (std::uint32_t i = 0; i < 10 + 5 * static_cast<std::uint32_t>(round); ++i) {
            const Vector low(far + random.between(0.0, 1.0), random.between(0.0, 1.0) - far);
            const Vector extent(random.between(0.0, size), random.below(5) * size / 4.0);
            given.emplace_back(low, low + extent);
        }
        std::vector<Box> joined = given;
        join_boxes(joined);
        for (const Box& box : given) {
            EXPECT_EQ(std::count_if(joined.begin(), joined.end(),
                                    [&](const Box& j) { return j.contains(box); }),
                      1)
                << "round " << round;
        }
        for (std::size_t i = 0; i < joined.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_FALSE(joined[i].intersects(joined[j])) << "round " << round;
            }
        }
        std::vector<Box> again = joined;
        join_boxes(again);
        EXPECT_EQ(again.size(), joined.size()) << "round " << round;
    }
}

}  // namespace
}  // namespace nearfield::geometry
