#include <engine/geometry/segment.hpp>
#include <engine/raster/nearest_edges.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>
#include <tests/unit/support/tile_cases.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nearfield::raster {
namespace {

using geometry::Vector;
using test::cases;
using test::height;
using test::width;

TEST(NearestEdges, HoldTheNearestEdgeOfEveryNeededSampleOnItsSide) {
    const double slack = 0.5;
    const double deviation = 0.3;
    std::vector<NearestEdge> found;
    NearestEdgeFinder finder;
    test::Random random(9);
    for (const auto& c : cases(deviation)) {
        device_input::NeededBlocks needed(width, height);
        std::vector<Vector> samples;
        for (int i = 0; i < 30; ++i) {
            const Vector p(random.between(0.0, width), random.between(0.0, height));
            needed.add(static_cast<std::uint32_t>(p.x()), static_cast<std::uint32_t>(p.y()));
            samples.push_back(p);
        }
        finder.find(c->boundary(), needed, slack, found);
        std::vector<const NearestEdge*> by_edge(c->boundary().size(), nullptr);
        for (const NearestEdge& edge : found) {
            by_edge[edge.edge.simplified] = &edge;
        }
        for (const Vector& p : samples) {
            double nearest = 1e300;
            std::vector<double> distances;
            for (std::uint32_t e = 0; e < c->boundary().size(); ++e) {
                distances.push_back(std::sqrt(
                    geometry::nearest_on_segment(p, c->boundary().start(e), c->boundary().end(e))
                        .squared_distance));
                nearest = std::min(nearest, distances.back());
            }
            for (std::uint32_t e = 0; e < c->boundary().size(); ++e) {
                // Any edge that the deviation may make nearest.
                if (distances[e] > nearest + 2.0 * deviation) {
                    continue;
                }
                ASSERT_NE(by_edge[e], nullptr)
                    << c->name << ": edge " << e << " at " << p.transpose();
                if (distances[e] == nearest) {
                    const double left = geometry::cross(
                        c->boundary().end(e) - c->boundary().start(e), p - c->boundary().start(e));
                    const double reach =
                        left >= 0.0 ? by_edge[e]->reach_left : by_edge[e]->reach_right;
                    ASSERT_GE(reach, nearest) << c->name << ": edge " << e;
                }
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::raster
