#include <engine/geometry/placed_polygon.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/plan/nearest_edges.hpp>
#include <engine/plan/tile_edges.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace nearfield::plan {
namespace {

using geometry::PlacedPolygon;
using geometry::Polygon;
using geometry::Vector;

constexpr std::uint32_t width = 40;
constexpr std::uint32_t height = 24;

/// A shape over, around or beside a tile of 40 x 24 cells of side 1, low corner at the origin.
struct Case {
    std::string name;
    Polygon polygon;
    Pose pose;
    std::vector<geometry::SimplifiedEdge> edges;
    TileBoundary boundary;

    Case(const test::NamedRings& shape, std::uint64_t seed, double deviation) {
        test::Random random(seed);
        const double size = random.scale(3.0, 3e5);
        name = shape.name + ", seed " + std::to_string(seed);
        EXPECT_TRUE(polygon.assign(test::scaled_and_moved(shape.rings, size, {})).ok()) << name;
        pose = {{random.between(-0.7, 0.7) * size + 0.5 * width,
                 random.between(-0.7, 0.7) * size + 0.5 * height},
                random.between(0.0, 7.0)};
        geometry::simplify(polygon, deviation, 64.0, edges);
        boundary.place(polygon, edges, ToCells(PlacedPolygon(polygon, pose), Vector::Zero(), 1.0));
    }
};

std::vector<std::unique_ptr<Case>> cases(double deviation) {
    std::vector<std::unique_ptr<Case>> all;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        for (const test::NamedRings& shape : test::every_family(seed)) {
            all.push_back(std::make_unique<Case>(shape, 1000 * seed + all.size(), deviation));
        }
    }
    return all;
}

bool crosses(const Vector& p, const Vector& a, const Vector& b) {
    return (a.y() > p.y()) != (b.y() > p.y()) &&
           p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

TEST(TileBoundary, RingsClose) {
    for (const auto& c : cases(0.3)) {
        for (std::uint32_t i = 0; i < c->boundary.size(); ++i) {
            ASSERT_EQ(c->edges[i].last, c->edges[c->boundary.next[i]].first) << c->name;
            ASSERT_EQ(c->boundary.previous[c->boundary.next[i]], i) << c->name;
        }
    }
}

TEST(CrossingEdges, GiveTheParityOfTheWholeBoundary) {
    test::Random random(5);
    for (const auto& c : cases(0.3)) {
        std::vector<TileEdge> crossing;
        crossing_edges(c->boundary, width, height, 0.3, crossing);
        for (int i = 0; i < 100; ++i) {
            const Vector p(random.between(0.0, width), random.between(0.0, height));
            bool whole = false;
            double distance = 1e300;
            for (std::uint32_t e = 0; e < c->boundary.size(); ++e) {
                const Vector& a = c->boundary.start(e);
                const Vector& b = c->boundary.end(e);
                whole = whole != crosses(p, a, b);
                distance =
                    std::min(distance, geometry::nearest_on_segment(p, a, b).squared_distance);
            }
            bool odd = false;
            for (const TileEdge& edge : crossing) {
                odd = odd != crosses(p, edge.a, edge.b);
                EXPECT_LE(edge.simplified == no_simplified ? edge.a.x() : 0.0, width + 2.0);
            }
            if (distance > 1e-12) {
                ASSERT_EQ(odd, whole) << c->name << " at " << p.transpose();
            }
        }
    }
}

TEST(NearestEdges, HoldTheNearestEdgeOfEveryNeededSampleOnItsSide) {
    const double slack = 0.5;
    const double deviation = 0.3;
    std::vector<NearestEdge> found;
    NearestEdgeFinder finder;
    test::Random random(9);
    for (const auto& c : cases(deviation)) {
        NeededBlocks needed(width, height);
        std::vector<Vector> samples;
        for (int i = 0; i < 30; ++i) {
            const Vector p(random.between(0.0, width), random.between(0.0, height));
            needed.add(static_cast<std::uint32_t>(p.x()), static_cast<std::uint32_t>(p.y()));
            samples.push_back(p);
        }
        finder.find(c->boundary, needed, slack, found);
        std::vector<const NearestEdge*> by_edge(c->boundary.size(), nullptr);
        for (const NearestEdge& edge : found) {
            by_edge[edge.edge.simplified] = &edge;
        }
        for (const Vector& p : samples) {
            double nearest = 1e300;
            std::vector<double> distances;
            for (std::uint32_t e = 0; e < c->boundary.size(); ++e) {
                distances.push_back(std::sqrt(
                    geometry::nearest_on_segment(p, c->boundary.start(e), c->boundary.end(e))
                        .squared_distance));
                nearest = std::min(nearest, distances.back());
            }
            for (std::uint32_t e = 0; e < c->boundary.size(); ++e) {
                // Any edge as near as the true boundary may make it.
                if (distances[e] > nearest + 2.0 * deviation) {
                    continue;
                }
                ASSERT_NE(by_edge[e], nullptr)
                    << c->name << ": edge " << e << " at " << p.transpose();
                if (distances[e] == nearest) {
                    const double left = geometry::cross(c->boundary.end(e) - c->boundary.start(e),
                                                        p - c->boundary.start(e));
                    const double reach =
                        left >= 0.0 ? by_edge[e]->reach_left : by_edge[e]->reach_right;
                    ASSERT_GE(reach, nearest) << c->name << ": edge " << e;
                }
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::plan
