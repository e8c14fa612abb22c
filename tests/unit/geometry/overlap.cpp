#include <engine/geometry/overlap.hpp>
#include <engine/geometry/segment.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::geometry {
namespace {

using ChainFinder = Effort (*)(const TransformedPolygon&, const TransformedPolygon&,
                               const OverlapOptions&, std::vector<Chain>&);

double distance_to_boundary(const TransformedPolygon& placed, const Vector& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < placed.polygon().size(); ++i) {
        const Vector a = placed.vertex(i);
        const Vector b = placed.vertex(placed.polygon().next(i));
        least = std::min(least, nearest_on_segment(p, a, b).squared_distance);
    }
    return std::sqrt(least);
}

/// The results of brute force for each edge of A.
struct Wanted {
    std::vector<bool> near;       ///< a sample is within `grow` of B's boundary
    std::vector<bool> in_volume;  ///< or inside B
};

Wanted wanted_edges(const TransformedPolygon& a, const TransformedPolygon& b, double grow) {
    Wanted wanted;
    for (std::uint32_t i = 0; i < a.polygon().size(); ++i) {
        const Vector from = a.vertex(i);
        const Vector to = a.vertex(a.polygon().next(i));
        bool near = false;
        bool inside = false;
        for (int k = 0; k < 6; ++k) {
            const Vector p = from + k / 5.0 * (to - from);
            near = near || distance_to_boundary(b, p) <= grow;
            inside = inside || contains(b, p);
        }
        wanted.near.push_back(near);
        wanted.in_volume.push_back(near || inside);
    }
    return wanted;
}

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

void expect_superset(const std::vector<bool>& covered, const std::vector<bool>& wanted,
                     const std::string& what) {
    for (std::size_t i = 0; i < covered.size(); ++i) {
        EXPECT_TRUE(covered[i] || !wanted[i]) << what << ": edge " << i;
    }
}

/// Both functions at all heights: no wanted edge is omitted, and, if the boxes of nodes lie in
/// those of their parents, no height covers an edge that a lower one omitted.
void expect_lawful(const TransformedPolygon& a, const TransformedPolygon& b, double grow,
                   const std::string& what, BoundingVolume volume_type, const Wanted& wanted) {
    std::vector<bool> near_before(a.polygon().size(), true);
    std::vector<bool> volume_before = near_before;
    std::vector<Chain> chains;
    for (std::uint32_t height = 0; height <= 12; ++height) {
        const std::string where = what + ", height " + std::to_string(height);
        chains.clear();
        chains_near_boundary(a, b, {height, grow, volume_type}, chains);
        const std::vector<bool> near = covered_edges(a, chains, where + ", near");
        expect_superset(near, wanted.near, where + ", near");
        const bool nested = volume_type == BoundingVolume::axis_aligned;
        if (nested) {
            expect_superset(near_before, near, where + ", near, refined");
        }
        chains.clear();
        chains_in_volume(a, b, {height, grow, volume_type}, chains);
        const std::vector<bool> volume = covered_edges(a, chains, where + ", volume");
        expect_superset(volume, wanted.in_volume, where + ", volume");
        if (nested) {
            expect_superset(volume_before, volume, where + ", volume, refined");
        }
        near_before = near;
        volume_before = volume;
    }
}

void expect_lawful(const TransformedPolygon& a, const TransformedPolygon& b, double grow,
                   const std::string& what) {
    const Wanted wanted = wanted_edges(a, b, grow);
    expect_lawful(a, b, grow, what + ", axis-aligned", BoundingVolume::axis_aligned, wanted);
    expect_lawful(a, b, grow, what + ", oriented", BoundingVolume::oriented, wanted);
}

TEST(Chains, NothingWantedIsLeftOut) {
    samples::Random random(1);
    const std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    for (const samples::NamedRings& shape_a : shapes) {
        for (const samples::NamedRings& shape_b : shapes) {
            const double far = random.below(2) == 0 ? 0.0 : 1e6;
            const Polygon a = samples::polygon(shape_a.rings);
            const Polygon b = samples::polygon(samples::moved(shape_b.rings, -far, far));
            const double reach = random.between(0.0, 2.0);
            const double grow = random.below(2) == 0 ? 0.0 : random.between(0.0, 0.2);
            const Pose pose_a{{far + reach, -far}, random.between(0.0, 6.0)};
            const double angle = random.between(-0.5, 0.5);
            // B's own coordinates are far from its origin: this moves it back after the rotation.
            const Vector back = Eigen::Rotation2Dd(angle) * Vector(far, -far);
            const Pose pose_b{{far + back.x(), -far + back.y()}, angle};
            expect_lawful(TransformedPolygon(a, pose_a), TransformedPolygon(b, pose_b), grow,
                          shape_a.name + " against " + shape_b.name + ", far " +
                              std::to_string(far) + ", grow " + std::to_string(grow));
        }
    }
}

void expect_same(const std::vector<Chain>& found, const std::vector<Chain>& wanted,
                 const std::string& what) {
    ASSERT_EQ(found.size(), wanted.size()) << what;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_EQ(found[i].ring, wanted[i].ring) << what;
        EXPECT_EQ(found[i].first, wanted[i].first) << what;
        EXPECT_EQ(found[i].count, wanted[i].count) << what;
        EXPECT_EQ(found[i].box.min(), wanted[i].box.min()) << what;
        EXPECT_EQ(found[i].box.max(), wanted[i].box.max()) << what;
    }
}

TEST(Chains, OfBothAreFoundByOneDescent) {
    samples::Random random(8);
    const std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    for (const samples::NamedRings& shape_a : shapes) {
        for (const samples::NamedRings& shape_b : shapes) {
            const Polygon polygon_a = samples::polygon(shape_a.rings);
            const Polygon polygon_b = samples::polygon(shape_b.rings);
            const TransformedPolygon a(polygon_a, {{random.between(0.0, 2.0), 0.1}, 1.0});
            const TransformedPolygon b(polygon_b, {});
            for (const BoundingVolume volume :
                 {BoundingVolume::axis_aligned, BoundingVolume::oriented}) {
                const OverlapOptions options{random.below(13), 0.0, volume};
                const std::string what = shape_a.name + " and " + shape_b.name + ", height " +
                                         std::to_string(options.height);
                std::vector<Chain> of_a;
                std::vector<Chain> of_b;
                const Effort both = chains_in_each_other(a, b, options, of_a, of_b);
                std::vector<Chain> wanted;
                const Effort one = chains_in_volume(a, b, options, wanted);
                EXPECT_EQ(both.nodes_evaluated, one.nodes_evaluated) << what;
                expect_same(of_a, wanted, what + ", of A");
                wanted.clear();
                chains_in_volume(b, a, options, wanted);
                expect_same(of_b, wanted, what + ", of B");
            }
        }
    }
}

TEST(Chains, ManyRingsInsideOrInAHole) {
    samples::Random random(7);
    samples::Rings islands;
    for (int i = 0; i < 13; ++i) {
        islands.push_back(samples::moved({samples::star(random, 7, 0.1, 0.4)}, i, 0.0).front());
    }
    const Polygon archipelago = samples::polygon(islands);
    const TransformedPolygon a(archipelago, {});
    const Ring sea = samples::rectangle(-1.0, -1.0, 20.0, 1.0);
    const Polygon solid = samples::polygon({sea});
    // Contains the rings from 3 to 5, with the others in its hole.
    const Polygon holed = samples::polygon(
        {sea, samples::rectangle(-0.9, -0.9, 19.0, 0.9), samples::rectangle(2.5, -0.8, 5.5, 0.8)});
    std::vector<Chain> chains;
    chains_in_volume(a, TransformedPolygon(solid, {}), {8, 0.0}, chains);
    ASSERT_EQ(chains.size(), 13U);
    for (const Chain& chain : chains) {
        EXPECT_EQ(chain.count, 7U);
    }
    chains.clear();
    chains_in_volume(a, TransformedPolygon(holed, {}), {8, 0.0}, chains);
    ASSERT_EQ(chains.size(), 3U);
    EXPECT_EQ(chains.front().ring, 3U);
    EXPECT_EQ(chains.back().ring, 5U);
}

/// With single edges as leaves, an edge is near exactly if its box overlaps that of an edge.
TEST(Chains, FullHeightComparesSingleEdges) {
    samples::Random random(3);
    for (int round = 0; round < 20; ++round) {
        const Polygon polygon_a = samples::polygon({samples::coast(random, 200, 1.0)});
        const Polygon polygon_b = samples::polygon(
            {samples::coast(random, 150, 1.0), samples::star(random, 30, 0.1, 0.3)});
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
    samples::Random random(5);
    const Polygon polygon = samples::polygon({samples::star(random, 4096, 1.0, 1.0)});
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

TEST(Chains, OrientedBoxesTellSlantedCombsApart) {
    // The teeth of one in the gaps of the other: in world axes, boxes of slanted teeth overlap
    // those of their neighbours at any size.
    const std::uint32_t teeth = 64;
    const Polygon comb = samples::polygon({samples::comb(teeth)});
    const double turn = 0.7;
    const Vector to = Eigen::Rotation2Dd(turn) * Vector(0.89 * 2.0 / teeth, 0.5);
    const TransformedPolygon a(comb, {{0.0, 0.0}, turn});
    const TransformedPolygon b(comb, {{to.x(), to.y()}, turn + 3.14159265358979});
    std::array<Effort, 2> efforts;
    std::array<std::uint32_t, 2> kept{};
    for (const BoundingVolume volume : {BoundingVolume::axis_aligned, BoundingVolume::oriented}) {
        const auto which = static_cast<std::size_t>(volume);
        std::vector<Chain> chains;
        efforts[which] = chains_near_boundary(a, b, {16, 0.0, volume}, chains);
        for (const Chain& chain : chains) {
            kept[which] += chain.count;
        }
    }
    EXPECT_LT(efforts[1].nodes_evaluated, efforts[0].nodes_evaluated);
    EXPECT_GT(kept[0], 0U);
    EXPECT_EQ(kept[1], 0U);
}

TEST(Chains, OfManyRingsAgainstManyAreFoundByOneSweep) {
    // Testing each ring against all of B would take seconds instead of milliseconds.
    constexpr int side = 100;
    samples::Rings rings;
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side; ++y) {
            rings.push_back(samples::rectangle(x, y, x + 0.4, y + 0.4));
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
    samples::Random random(6);
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
