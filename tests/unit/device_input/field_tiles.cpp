#include <engine/device_input/field_tiles.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

namespace nearfield::device_input {
namespace {

using geometry::Vector;

geometry::Polygon coast(int vertices) {
    test::Random random(11);
    geometry::Polygon polygon;
    EXPECT_TRUE(polygon.assign(test::coast(random, vertices, 0.5)).ok());
    return polygon;
}

double number(std::uint32_t word) {
    return static_cast<double>(std::bit_cast<float>(word));
}

/// A shape as the device reads it.
class Layout {
public:
    Layout(const SearchShapes& shapes, std::uint32_t first)
        : units_(shapes.units()),
          chunks_(units_[first][0]),
          edges_(units_[first][2]),
          infos_(units_[first][3]),
          low_(units_[first + shaders::unit_of_rings][1] / 4 +
               (units_[first + shaders::unit_of_rings][0] + 3) / 4) {}

    [[nodiscard]] std::uint32_t chunks() const { return chunks_; }
    [[nodiscard]] std::uint32_t info(std::uint32_t chunk) const {
        return units_[infos_ / 4 + chunk / 4][chunk % 4];
    }
    [[nodiscard]] double coordinate(std::uint32_t slot, std::size_t i) const {
        return number(units_[edges_ + slot][i]) + number(units_[low_ + slot][i]);
    }

private:
    std::span<const SearchUnit> units_;
    std::uint32_t chunks_, edges_, infos_, low_;
};

// GCC 12 was seen to drop the rounding of the first of two floats.
TEST(FieldTiles, EdgesHaveTwiceThePrecision) {
    const geometry::Polygon polygon = coast(1000);
    SearchShapes shapes;
    shapes.begin_batch();
    const Layout layout(shapes, shapes.place_for_field(polygon, 0.0));
    const double unit = unit_length_of(polygon);
    std::uint32_t edges = 0;
    for (std::uint32_t chunk = 0; chunk < layout.chunks(); ++chunk) {
        for (std::uint32_t i = 0; i < (layout.info(chunk) & 15U); ++i, ++edges) {
            const std::uint32_t edge = (layout.info(chunk) >> 4U) + i;
            const Vector a = polygon.vertices()[edge] / unit;
            const Vector b = polygon.vertices()[polygon.next(edge)] / unit;
            const std::uint32_t slot = shaders::chunk_size * chunk + i;
            for (const int axis : {0, 1}) {
                const auto place = static_cast<std::size_t>(axis);
                ASSERT_NEAR(layout.coordinate(slot, place), a[axis], std::ldexp(1.0, -47));
                ASSERT_NEAR(layout.coordinate(slot, place + 2), b[axis], std::ldexp(1.0, -47));
            }
        }
    }
    EXPECT_EQ(edges, polygon.size());
}

TEST(FieldTiles, SimplifiedBoundariesStayWithinTheirDeviation) {
    const geometry::Polygon polygon = coast(1000);
    constexpr double deviation = 0.02;
    SearchShapes shapes;
    shapes.begin_batch();
    const Layout layout(shapes, shapes.place_for_field(polygon, deviation));
    const double unit = unit_length_of(polygon);
    std::vector<double> nearest(polygon.size(), INFINITY);
    std::uint32_t edges = 0;
    for (std::uint32_t chunk = 0; chunk < layout.chunks(); ++chunk) {
        for (std::uint32_t i = 0; i < (layout.info(chunk) & 15U); ++i, ++edges) {
            const std::uint32_t slot = shaders::chunk_size * chunk + i;
            const Vector a(layout.coordinate(slot, 0), layout.coordinate(slot, 1));
            const Vector b(layout.coordinate(slot, 2), layout.coordinate(slot, 3));
            for (std::uint32_t vertex = 0; vertex < polygon.size(); ++vertex) {
                const double squared =
                    geometry::nearest_on_segment(polygon.vertices()[vertex], unit * a, unit * b)
                        .squared_distance;
                nearest[vertex] = std::min(nearest[vertex], std::sqrt(squared));
            }
        }
    }
    EXPECT_LT(edges, polygon.size() / 2);
    for (const double distance : nearest) {
        EXPECT_LE(distance, deviation * (1.0 + 1e-9));
    }
}

TEST(FieldTiles, AreWhereTheirTilesAre) {
    const geometry::Polygon polygon = coast(100);
    PlannedQuery query;
    query.b = &polygon;
    query.pose_b = {{1e6, -1e6}, 0.7};
    query.work.emplace<PlannedField>();
    PlannedTile tile;
    tile.grid = {Vector(1e6 - 0.5, -1e6 + 0.25), 1e-3, 500, 300};
    tile.column = 130;
    tile.width = 200;
    tile.height = 65;
    ShapesInTiles shapes;
    FieldWork work;
    add_field_tile(query, tile, 7, shaders::not_asked, shaders::not_asked, shapes, work);
    EXPECT_EQ(work.blocks, 0U) << "it only serves points";
    add_field_tile(query, tile, 7, 11, shaders::not_asked, shapes, work);
    add_field_tile(query, tile, 7, 12, 13, shapes, work);
    EXPECT_EQ(work.tiles[2].first_region, 4U * 2U);
    EXPECT_EQ(work.tiles[2].first_quarter, 7U * 3U);
    EXPECT_EQ(work.tiles[2].first_block, 13U * 5U);
    EXPECT_EQ(work.blocks, 2U * 13U * 5U);
    EXPECT_EQ(work.tiles[2].first_row, 65U);
    EXPECT_EQ(work.rows, 2U * 65U);
    const shaders::ShapeInTileData& data = work.tiles.back().b;
    const geometry::TransformedPolygon placed(polygon, query.pose_b);
    const double unit = unit_length_of(polygon);
    const auto sum = [](float high, float low) {
        return static_cast<double>(high) + static_cast<double>(low);
    };
    const Vector axis(sum(data.axis.x, data.axis_low.x), sum(data.axis.y, data.axis_low.y));
    const Vector offset(sum(data.offset.x, data.offset_low.x),
                        sum(data.offset.y, data.offset_low.y));
    for (const Vector& vertex : polygon.vertices()) {
        const Vector v = vertex / unit;
        const Vector there(axis.x() * v.x() - axis.y() * v.y() + offset.x(),
                           axis.y() * v.x() + axis.x() * v.y() + offset.y());
        const Vector expected = (placed.to_world(vertex) - tile.origin()) / tile.grid.cell;
        EXPECT_LT((there - expected).norm(), 1e-6) << "cells";
    }
}

}  // namespace
}  // namespace nearfield::device_input
