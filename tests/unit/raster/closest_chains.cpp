#include <engine/geometry/segment.hpp>
#include <engine/raster/closest_chains.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::raster {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;

/// For each edge of A its distance to B's boundary.
std::vector<double> edge_distances(const TransformedPolygon& a, const TransformedPolygon& b) {
    std::vector<double> distances;
    for (std::uint32_t i = 0; i < a.polygon().size(); ++i) {
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t j = 0; j < b.polygon().size(); ++j) {
            least = std::min(
                least, geometry::closest_of_segments(a.vertex(i), a.vertex(a.polygon().next(i)),
                                                     b.vertex(j), b.vertex(b.polygon().next(j)))
                           .squared_distance);
        }
        distances.push_back(std::sqrt(least));
    }
    return distances;
}

TEST(ClosestChains, HoldTheClosestEdgesAtEveryHeight) {
    samples::Random random(5);
    const auto shapes = samples::assorted_shapes(random);
    ClosestChains closest;
    std::size_t edges_kept = 0;
    std::size_t edges_in_all = 0;
    for (const auto& first : shapes) {
        for (const auto& second : shapes) {
            for (const std::uint32_t height : {0U, 1U, 2U, 5U, 12U}) {
                // Oriented boxes for every other height.
                const auto volume =
                    height % 2 == 0 ? BoundingVolume::axis_aligned : BoundingVolume::oriented;
                SCOPED_TRACE(first.name + " and " + second.name + ", height " +
                             std::to_string(height));
                const Polygon polygon_a = samples::polygon(first.rings);
                const Polygon polygon_b = samples::polygon(second.rings);
                const TransformedPolygon a(polygon_a, {{}, random.between(-3.0, 3.0)});
                const TransformedPolygon b(polygon_b, {{2.5, random.between(-1.0, 1.0)}, 0.4});
                const std::vector<double> distances = edge_distances(a, b);
                const double least = *std::min_element(distances.begin(), distances.end());
                std::vector<geometry::Chain> chains;
                closest.find(a, b, {height, 0.0, volume}, chains);
                EXPECT_GE(closest.upper_bound(), least);
                std::vector<bool> kept(a.polygon().size(), false);
                std::uint32_t last = 0;
                for (const geometry::Chain& chain : chains) {
                    EXPECT_GE(chain.first, last) << "out of order";
                    last = chain.first;
                    for (std::uint32_t i = chain.first; i < chain.first + chain.count; ++i) {
                        EXPECT_FALSE(kept[i]) << "edge " << i << " twice";
                        kept[i] = true;
                        EXPECT_TRUE(chain.box.contains(a.vertex(i)));
                    }
                }
                for (std::uint32_t i = 0; i < a.polygon().size(); ++i) {
                    EXPECT_TRUE(kept[i] || distances[i] > least) << "edge " << i;
                    edges_kept += kept[i] && height == 12 ? 1U : 0U;
                    edges_in_all += height == 12 ? 1U : 0U;
                }
            }
        }
    }
    EXPECT_LT(edges_kept, edges_in_all / 5) << "of all edges of A";
}

TEST(ClosestChains, LookOnlyWhereTheClosestCanBe) {
    samples::Random random(6);
    const Polygon polygon_a = samples::polygon({samples::coast(random, 4096, 1.0)});
    const Polygon polygon_b = samples::polygon({samples::coast(random, 4096, 1.0)});
    const TransformedPolygon a(polygon_a, {});
    const TransformedPolygon b(polygon_b, {{5.0, 0.0}, 1.0});
    ClosestChains closest;
    std::vector<geometry::Chain> chains;
    const geometry::Effort effort =
        closest.find(a, b, {12, 0.0, BoundingVolume::axis_aligned}, chains);
    EXPECT_LT(effort.nodes_evaluated, 1500U) << "of 16382 that there are";
    EXPECT_GT(effort.pairs_rejected, 0U);
}

}  // namespace
}  // namespace nearfield::raster
