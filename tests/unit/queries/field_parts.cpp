#include <engine/queries/field_parts.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace nearfield::queries {
namespace {

TEST(FieldParts, NothingIsDrawnOrReadBackThatNobodyAskedFor) {
    DistanceFieldQuery query;
    FieldParts parts = field_parts(query);
    EXPECT_TRUE(parts.values);
    EXPECT_FALSE(parts.features || parts.blended || parts.gradients || parts.small_tiles);
    EXPECT_EQ(parts.halo, 0U);

    const std::vector<Vector2> points(3);
    query.points = points;
    query.values = false;
    parts = field_parts(query);
    EXPECT_FALSE(parts.values || parts.features || parts.blended || parts.gradients);
    EXPECT_EQ(parts.halo, 1U);
    EXPECT_EQ(parts.cells_per_point, 4U);
    EXPECT_EQ(parts.words_per_point, 5U);
}

TEST(FieldParts, DifferencesLookOneCellFarther) {
    const std::vector<Vector2> points(3);
    DistanceFieldQuery query;
    query.values = false;
    query.gradients = true;
    query.gradient = GradientMethod::central_differences;
    FieldParts parts = field_parts(query);
    EXPECT_TRUE(parts.values);
    EXPECT_FALSE(parts.gradients || parts.features || parts.small_tiles);
    EXPECT_EQ(parts.halo, 1U);
    query.points = points;
    parts = field_parts(query);
    EXPECT_EQ(parts.halo, 2U);
    EXPECT_EQ(parts.words_per_point, 1 + parts.cells_per_point);
    query.gradient = GradientMethod::blended;
    parts = field_parts(query);
    EXPECT_TRUE(parts.values && parts.blended && parts.gradients);
    EXPECT_EQ(parts.words_per_point, 1 + parts.cells_per_point + 2 * 4);
    query.gradient = GradientMethod::analytic;
    query.points = {};
    parts = field_parts(query);
    EXPECT_TRUE(parts.features && parts.small_tiles);
    EXPECT_EQ(parts.halo, 0U);
}

/// Small tiles for points must not depend on the other outputs: the image and the cells alone must
/// agree bit for bit.
TEST(FieldParts, PointsDecideTheTiles) {
    const std::vector<Vector2> points(1);
    DistanceFieldQuery query;
    query.points = points;
    EXPECT_TRUE(field_parts(query).small_tiles);
    query.values = false;
    EXPECT_TRUE(field_parts(query).small_tiles);
}

}  // namespace
}  // namespace nearfield::queries
