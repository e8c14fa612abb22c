#include <engine/queries/simplified_shapes.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <deque>
#include <string>
#include <vector>

namespace nearfield::queries {
namespace {

using geometry::Polygon;

void expect_simplified(const SimplifiedBoundary& found, const Polygon& polygon, double deviation,
                       const std::string& what) {
    std::vector<geometry::SimplifiedEdge> wanted;
    geometry::simplify(polygon, deviation, 10.0, wanted);
    ASSERT_EQ(found.polygon, &polygon) << what;
    ASSERT_EQ(found.edges.size(), wanted.size()) << what;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        ASSERT_EQ(found.edges[i].first, wanted[i].first) << what;
        ASSERT_EQ(found.edges[i].last, wanted[i].last) << what;
    }
    ASSERT_EQ(found.ring_begin.size(), polygon.ring_count() + 1U) << what;
    ASSERT_EQ(found.ring_begin.back(), wanted.size()) << what;
}

TEST(SimplifiedShapes, GiveEachShapeAtEachTolerance) {
    test::Random random(11);
    std::deque<Polygon> polygons;
    for (int i = 0; i < 300; ++i) {
        const test::NamedRings shape = test::any_shape(random);
        ASSERT_TRUE(polygons.emplace_back().assign(shape.rings).ok()) << shape.name;
    }
    SimplifiedShapes shapes;
    for (int batch = 0; batch < 2; ++batch) {
        shapes.clear();
        for (int repeat = 0; repeat < 2; ++repeat) {
            for (std::size_t i = 0; i < polygons.size(); ++i) {
                for (const double deviation : {0.001, 0.1}) {
                    expect_simplified(shapes.get(polygons[i], deviation, 10.0), polygons[i],
                                      deviation, "seed 11, shape " + std::to_string(i));
                }
            }
        }
    }
}

TEST(SimplifiedShapes, AreNewInEachBatch) {
    test::Random random(12);
    Polygon polygon;
    SimplifiedShapes shapes;
    for (const int n : {500, 20}) {
        ASSERT_TRUE(polygon.assign(test::coast(random, n, 0.5)).ok());
        shapes.clear();
        expect_simplified(shapes.get(polygon, 0.001, 10.0), polygon, 0.001, "seed 12");
    }
}

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
    expect_simplified(shapes.get(polygon, 1e-9, 10.0), polygon, 1e-9, "the first again");
}

}  // namespace
}  // namespace nearfield::queries
