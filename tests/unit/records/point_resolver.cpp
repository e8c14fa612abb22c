#include <engine/records/point_resolver.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

namespace nearfield::records {
namespace {

using geometry::Polygon;

/// The first vertex of A, beside the right side of a square: edge 1, between the edges 0 and 2.
class PointResolverTest : public testing::Test {
protected:
    PointResolverTest()
        : a_(samples::polygon({{{3.75, 1.0}, {3.0, 3.0}, {2.0, 2.0}}})),
          b_(samples::polygon({samples::rectangle(0.0, 0.0, 4.0, 4.0)})) {
        planned_.a = &a_;
        planned_.b = &b_;
        planned_.budget.cell = 0.01;
        plan::PlannedPoints& points = planned_.work.emplace<plan::PlannedPoints>();
        points.source = plan::PointSource::device;
        points.count = 1;
        plan_.points = {{{0, 0.0}, plan::PlannedPoint::no_tile}};
    }

    /// What the device found of the point is in `word`.
    ResolvedPoint resolved(std::uint32_t word) {
        resolver_.begin(plan_, planned_, {&word, 1});
        return resolver_.resolve(0);
    }

    static constexpr std::uint32_t found =
        plan::point_resolved | plan::point_inside | plan::point_unique;

    Polygon a_;
    Polygon b_;
    plan::Plan plan_;
    plan::PlannedQuery planned_;
    PointResolver resolver_;
};

TEST_F(PointResolverTest, TakesTheEdgeThatTheDeviceFound) {
    for (const std::uint32_t edge : {0U, 1U, 2U}) {
        EXPECT_EQ(resolved(found | edge).edge, edge);
    }
}

TEST_F(PointResolverTest, ComparesBothNeighboursWhereSinglePrecisionCannotTell) {
    planned_.points().margin = 1.0;
    for (const std::uint32_t edge : {0U, 1U, 2U}) {
        const ResolvedPoint point = resolved(found | edge);
        EXPECT_EQ(point.edge, 1U) << "found: " << edge;
        EXPECT_DOUBLE_EQ(point.distance, 0.25);
        EXPECT_TRUE(point.inside);
        EXPECT_TRUE(point.unique);
    }
}

TEST_F(PointResolverTest, AsksTheWholeBoundaryOfTheQueryAboutDoubtfulPoints) {
    constexpr std::uint32_t doubtful = plan::point_resolved | plan::point_doubtful;
    ResolvedPoint point = resolved(doubtful | 3U);
    EXPECT_EQ(point.edge, 1U);
    EXPECT_TRUE(point.inside);
    const Polygon other = samples::polygon({samples::rectangle(3.875, 0.0, 4.0, 4.0)});
    planned_.b = &other;
    point = resolved(doubtful | 1U);
    EXPECT_EQ(point.edge, 3U);
    EXPECT_DOUBLE_EQ(point.distance, 0.125);
    EXPECT_FALSE(point.inside);
}

}  // namespace
}  // namespace nearfield::records
