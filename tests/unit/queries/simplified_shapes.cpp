#include <engine/queries/simplified_shapes.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <vector>

namespace nearfield::queries {
namespace {

using geometry::Polygon;

TEST(SimplifiedShapes, StayRightWhereThereAreTooManyToKeep) {
    test::Random random(13);
    Polygon polygon;
    ASSERT_TRUE(polygon.assign(test::tangle(random, 20000)).ok());
    SimplifiedShapes shapes;
    for (int i = 1; i <= 60; ++i) {
        const SimplifiedBoundary found = shapes.get(polygon, 1e-9 * i, 10.0);
        ASSERT_EQ(found.size(), 20000U) << i;
        ASSERT_EQ(found.edges.front().first, 0U) << i;
        ASSERT_EQ(found.edges.back().last, 0U) << i;
    }
    const SimplifiedBoundary again = shapes.get(polygon, 1e-9, 10.0);
    std::vector<geometry::SimplifiedEdge> wanted;
    geometry::simplify(polygon, 1e-9, 10.0, wanted);
    ASSERT_EQ(again.polygon, &polygon);
    ASSERT_EQ(again.edges.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        ASSERT_EQ(again.edges[i].first, wanted[i].first);
        ASSERT_EQ(again.edges[i].last, wanted[i].last);
    }
    ASSERT_EQ(again.ring_begin.size(), polygon.ring_count() + 1U);
    ASSERT_EQ(again.ring_begin.back(), wanted.size());
}

}  // namespace
}  // namespace nearfield::queries
