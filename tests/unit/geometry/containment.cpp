#include <engine/geometry/containment.hpp>
#include <engine/geometry/segment.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace nearfield::geometry {
namespace {

/// The odd-even rule by a ray to the right of a point on a lattice that no vertex is level with.
bool is_inside(const std::vector<Ring>& rings, const Vector& point) {
    bool inside = false;
    const Vector to(1000.0, point.y() + 0.5);
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector a = to_vector(ring[i]);
            const Vector b = to_vector(ring[(i + 1) % ring.size()]);
            inside = inside != segments_intersect(point, to, a, b);
        }
    }
    return inside;
}

bool is_on_boundary(const std::vector<Ring>& rings, const Vector& point) {
    return std::any_of(rings.begin(), rings.end(), [&](const Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector a = to_vector(ring[i]);
            const Vector b = to_vector(ring[(i + 1) % ring.size()]);
            if (segments_intersect(point, point, a, b)) {
                return true;
            }
        }
        return false;
    });
}

/// Most points are level with vertices, wherever the rings begin.
TEST(Containment, AgreesWithARayOnALattice) {
    test::Random random(7);
    int inside = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<Ring> rings(1 + random.below(2));
        for (Ring& ring : rings) {
            const std::uint32_t size = 3 + random.below(6);
            for (std::uint32_t i = 0; i < size; ++i) {
                ring.push_back({static_cast<double>(2 * random.below(5)),
                                static_cast<double>(2 * random.below(5))});
            }
        }
        Polygon polygon;
        if (!polygon.assign(rings).ok()) {
            continue;  // on one line
        }
        const TransformedPolygon placed(polygon, {});
        Containment containment;
        std::vector<Vector> points;
        for (int x = 0; x < 9; ++x) {
            for (int y = 0; y < 9; ++y) {
                const Vector point(x, y);
                if (!is_on_boundary(rings, point)) {
                    points.push_back(point);
                    containment.ask(point);
                }
            }
        }
        containment.answer(placed);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool expected = is_inside(rings, points[i]);
            inside += expected ? 1 : 0;
            ASSERT_EQ(containment.inside(i), expected)
                << points[i].transpose() << " in round " << round;
            ASSERT_EQ(contains(placed, points[i]), expected)
                << points[i].transpose() << " in round " << round;
        }
    }
    EXPECT_GT(inside, 10000);
}

}  // namespace
}  // namespace nearfield::geometry
