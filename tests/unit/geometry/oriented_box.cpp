#include <engine/geometry/containment.hpp>
#include <engine/geometry/hierarchy.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::geometry {
namespace {

void expect_holds(const OrientedBox& box, const Vector& point) {
    const Vector v = point - box.centre;
    EXPECT_LE(std::abs(v.dot(box.axis)), box.half.x());
    EXPECT_LE(std::abs(cross(box.axis, v)), box.half.y());
}

TEST(OrientedBoxes, OfEveryNodeHoldItsVertices) {
    samples::Random random(1);
    for (const samples::NamedRings& shape : samples::assorted_shapes(random)) {
        for (const double far : {0.0, 1e6}) {
            SCOPED_TRACE(shape.name + ", far " + std::to_string(far));
            const Polygon polygon = samples::polygon(samples::moved(shape.rings, far, -far));
            const TransformedPolygon placed(polygon, {{-far, far}, random.between(0.0, 6.0)});
            Hierarchy tree(placed, 6, BoundingVolume::oriented);
            std::vector<Node> nodes{tree.root()};
            while (!nodes.empty()) {
                const Node node = nodes.back();
                nodes.pop_back();
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                    expect_holds(node.oriented, placed.vertex(i));
                    expect_holds(node.oriented, placed.vertex(polygon.next(i)));
                }
                if (tree.splits(node)) {
                    const auto halves = tree.halves(node);
                    nodes.insert(nodes.end(), halves.begin(), halves.end());
                }
            }
        }
    }
}

TEST(OrientedBoxes, FitSlantedChains) {
    // Along a slanted line an oriented box is a line, an axis-aligned one a square.
    const Polygon needle = samples::polygon({{{0, 0}, {4, 4}, {8, 8.001}, {4, 4.001}}});
    const TransformedPolygon placed(needle, {});
    Hierarchy tree(placed, 0, BoundingVolume::oriented);
    const Node root = tree.root();
    EXPECT_LT(root.oriented.half.y(), 0.001);
    EXPECT_NEAR(root.oriented.half.x(), 4.0 * std::sqrt(2.0), 0.01);
}

TEST(OrientedBoxes, AreApartExactlyBeyondTheirGap) {
    const OrientedBox a{{0, 0}, Vector(1, 1).normalized(), {2, 0.5}};
    const OrientedBox b{Vector(-1, 1).normalized() * 1.5, Vector(1, 1).normalized(), {2, 0.5}};
    EXPECT_NEAR(gap(a, b), 0.5, 1e-12);
    EXPECT_NEAR(gap(b, a), 0.5, 1e-12);
    EXPECT_LE(gap(a, a), 0.0);
    // Corner to side: only an axis of the second box separates them.
    const OrientedBox upright{{1.2, -1.2}, {1, 0}, {0.5, 0.5}};
    EXPECT_GT(gap(upright, {{0, 0}, Vector(1, 1).normalized(), {3, 0.5}}), 0.0);
}

TEST(Containment, AgreesWithOnePointAtATime) {
    samples::Random random(3);
    Containment containment;
    for (const samples::NamedRings& shape : samples::assorted_shapes(random)) {
        const Polygon polygon = samples::polygon(shape.rings);
        const TransformedPolygon placed(polygon, {{0.3, -0.2}, random.between(0.0, 6.0)});
        std::vector<Vector> points;
        for (int i = 0; i < 200; ++i) {
            points.emplace_back(random.between(-1.5, 1.5), random.between(-1.5, 1.5));
        }
        // Level with vertices, where an edge too many or too few would be noticed.
        for (std::uint32_t i = 0; i < polygon.size(); ++i) {
            const Vector& vertex = polygon.vertices()[i];
            points.push_back(placed.to_world(vertex + Vector(random.between(-1.0, 1.0), 0.0)));
        }
        containment.clear();
        for (const Vector& point : points) {
            containment.ask(point);
        }
        containment.answer(placed);
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(containment.inside(i), contains(placed, points[i]))
                << shape.name << ", " << i;
        }
    }
}

}  // namespace
}  // namespace nearfield::geometry
