#include <engine/batch/point_resolver.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <vector>

namespace nearfield::batch {
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
        device_input::PlannedPoints& points = planned_.work.emplace<device_input::PlannedPoints>();
        points.source = device_input::PointSource::device;
        points_ = {{{0, 0.0}, device_input::PlannedPoint::no_tile}};
    }

    /// What the device found of the point is in `word`.
    solvers::ResolvedPoint resolved(std::uint32_t word) {
        resolver_.begin(planned_, {*planned_.a, {}}, {*planned_.b, {}},
                        {.points = points_, .words = {&word, 1}});
        solvers::ResolvedPoint resolved;
        resolver_.for_each(
            [](std::uint32_t) { return true; },
            [&](std::uint32_t, const solvers::ResolvedPoint& point) { resolved = point; });
        return resolved;
    }

    static constexpr std::uint32_t found =
        shaders::point_resolved | shaders::point_inside | shaders::point_unique;

    Polygon a_;
    Polygon b_;
    std::vector<device_input::PlannedPoint> points_;
    device_input::PlannedQuery planned_;
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
        const solvers::ResolvedPoint point = resolved(found | edge);
        EXPECT_EQ(point.edge, 1U) << "found: " << edge;
        EXPECT_DOUBLE_EQ(point.distance, 0.25);
        EXPECT_TRUE(point.inside);
        EXPECT_TRUE(point.unique);
    }
}

TEST_F(PointResolverTest, AsksTheWholeBoundaryOfTheQueryAboutDoubtfulPoints) {
    constexpr std::uint32_t doubtful = shaders::point_resolved | shaders::point_doubtful;
    solvers::ResolvedPoint point = resolved(doubtful | 3U);
    EXPECT_EQ(point.edge, 1U);
    EXPECT_TRUE(point.inside);
    const Polygon other = samples::polygon({samples::rectangle(3.875, 0.0, 4.0, 4.0)});
    planned_.b = &other;
    point = resolved(doubtful | 1U);
    EXPECT_EQ(point.edge, 3U);
    EXPECT_DOUBLE_EQ(point.distance, 0.125);
    EXPECT_FALSE(point.inside);
}

/// Samples of A, more than a block holds, whose nearest edges are on either ring of B.
TEST_F(PointResolverTest, ResolvesManyPointsAsOneByOne) {
    const Polygon b = samples::polygon(
        {samples::rectangle(0.0, 0.0, 4.0, 4.0), samples::rectangle(1.0, 1.0, 2.5, 2.0)});
    planned_.b = &b;
    std::vector<std::uint32_t> words;
    points_.clear();
    for (std::uint32_t i = 0; i < 300; ++i) {
        points_.push_back({{i / 100, (i % 100) / 100.0}, device_input::PlannedPoint::no_tile});
        words.push_back(found | (i * 5 % 8));
    }
    const geometry::TransformedPolygon placed_a(a_, {});
    const geometry::TransformedPolygon placed_b(b, {});
    for (const double margin : {0.0, 1.0}) {
        planned_.points().margin = margin;
        resolver_.begin(planned_, {*planned_.a, {}}, {*planned_.b, {}},
                        {.points = points_, .words = words});
        std::uint32_t next = 0;
        resolver_.for_each(
            [](std::uint32_t) { return true; },
            [&](std::uint32_t i, const solvers::ResolvedPoint& point) {
                ASSERT_EQ(i, next++);
                std::uint32_t edge = words[i] & shaders::point_edge_mask;
                const geometry::Vector at = queries::position(placed_a, points_[i].point);
                geometry::NearestOnSegment nearest = solvers::nearest_on_edge(placed_b, edge, at);
                const std::uint32_t found_edge = edge;
                for (const std::uint32_t other : {b.previous(found_edge), b.next(found_edge)}) {
                    const auto on_other = solvers::nearest_on_edge(placed_b, other, at);
                    if (margin > 0.0 && on_other.squared_distance < nearest.squared_distance) {
                        nearest = on_other;
                        edge = other;
                    }
                }
                EXPECT_EQ(point.edge, edge) << i;
                EXPECT_EQ(point.nearest, nearest.point) << i;
                EXPECT_EQ(point.distance, std::sqrt(nearest.squared_distance)) << i;
                EXPECT_EQ(point.parameter, nearest.parameter) << i;
                const Feature feature = solvers::feature_at(placed_b, edge, nearest.parameter);
                EXPECT_EQ(point.feature.kind, feature.kind) << i;
                EXPECT_EQ(point.feature.index, feature.index) << i;
            });
        EXPECT_EQ(next, 300U);
    }
}

/// Both vertices of A that are inside are equally deep.
TEST_F(PointResolverTest, ListsPenetrationsAndTheFirstOfTheDeepest) {
    a_ = samples::polygon({{{3.0, 1.0}, {3.5, 2.0}, {3.0, 3.0}, {5.0, 2.0}}});
    points_.clear();
    std::vector<std::uint32_t> words;
    for (const std::uint32_t vertex : {1U, 0U, 2U, 3U}) {
        points_.push_back({{vertex, 0.0}, device_input::PlannedPoint::no_tile});
        words.push_back((vertex == 3 ? shaders::point_resolved : found) | 1U);
    }
    resolver_.begin(planned_, {*planned_.a, {}}, {*planned_.b, {}},
                    {.points = points_, .words = words});
    std::vector<PenetratingPoint> records(10);
    EXPECT_EQ(resolver_.list_penetrations(0.01, records), 1U);
    ASSERT_EQ(records.size(), 3U);
    EXPECT_DOUBLE_EQ(records[0].depth, 0.5);
    EXPECT_DOUBLE_EQ(records[1].depth, 1.0);
    EXPECT_DOUBLE_EQ(records[1].position.y, 1.0);
    EXPECT_DOUBLE_EQ(records[2].depth, 1.0);
}

}  // namespace
}  // namespace nearfield::batch
