#include "scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nearfield::test {
namespace {

/// Shapes whose rings deviate from their curves, by powers of two: sums of them are exact, and far
/// above the rounding.
constexpr double of_shape = 0x1p-5;
constexpr double of_instance = 0x1p-7;
constexpr double rounding = 1e-12;

/// A square of side 4 with its corner in the origin, as an instance, and one of side 1 to ask
/// about.
class WorldDeviations : public testing::Test {
protected:
    void SetUp() override {
        const auto square =
            scene_.context().add_shape(test::rectangle({0, 0}, {4, 4}), of_instance);
        const auto item = scene_.context().add_shape(test::rectangle({0, 0}, {1, 1}), of_shape);
        ASSERT_TRUE(square.has_value() && item.has_value());
        ASSERT_TRUE(scene_.world().add({*square, {}}).has_value());
        item_ = *item;
    }

    Clearance clearance(const Pose& pose) {
        Clearance found;
        EXPECT_TRUE(scene_.world().find_clearances({item_}, {&pose, 1}, {&found, 1}).ok());
        return found;
    }

    Scene scene_{{}};
    ShapeHandle item_;
};

TEST_F(WorldDeviations, OfBothShapesAreInTheBoundOfAClearance) {
    const Clearance apart = clearance({{6.0, 1.0}});
    EXPECT_EQ(apart.distance, 2.0);
    EXPECT_NEAR(apart.error_bound, of_shape + of_instance, rounding);
}

TEST_F(WorldDeviations, OfBothShapesAreInTheBoundOfADepth) {
    const Clearance of_vertex = clearance({{3.0, 1.5}});
    EXPECT_EQ(of_vertex.distance, -1.0);
    EXPECT_NEAR(of_vertex.error_bound, of_shape + of_instance, rounding);
    const Clearance touching = clearance({{4.0, 1.0}});
    EXPECT_EQ(touching.distance, 0.0);
    EXPECT_NEAR(touching.error_bound, of_shape + of_instance, rounding);
}

TEST_F(WorldDeviations, OfTheInstanceAreInTheBoundOfANearestPoint) {
    const Vector2 point{6.0, 1.0};
    for (const NearestKind kind : {NearestKind::instances, NearestKind::edges}) {
        NearestQuery query;
        query.kind = kind;
        NearestHit hit;
        ASSERT_TRUE(scene_.world().find_nearest(query, {&point, 1}, {&hit, 1}).ok());
        EXPECT_EQ(hit.distance, 2.0);
        EXPECT_NEAR(hit.error_bound, of_instance, rounding);
    }
}

TEST_F(WorldDeviations, OfBothShapesAreInTheBoundOfAnEdgeNearAShape) {
    const Pose pose{{6.0, 1.0}};
    ShapeEdgeHit hit;
    ASSERT_TRUE(scene_.world().find_nearest(ShapeEdgeQuery{item_}, {&pose, 1}, {&hit, 1}).ok());
    EXPECT_EQ(hit.distance, 2.0);
    EXPECT_NEAR(hit.error_bound, of_shape + of_instance, rounding);
}

TEST_F(WorldDeviations, OfTheInstanceAreInTheBoundOfARaysHit) {
    const Segment segment{{6.0, 1.0}, {2.0, 1.0}};
    RayHit hit;
    ASSERT_TRUE(scene_.world().cast_rays({&segment, 1}, {&hit, 1}).ok());
    EXPECT_EQ(hit.parameter, 0.5);
    EXPECT_NEAR(hit.error_bound, of_instance, rounding);
}

TEST_F(WorldDeviations, OfBothShapesAreInTheBoundOfACast) {
    ShapeCastQuery query;
    query.shape = item_;
    query.tolerance = 0.2;
    const Sweep sweep{{{6.0, 1.0}}, {{2.0, 1.0}}};
    ShapeCastHit hit;
    ASSERT_TRUE(scene_.world().cast_shape(query, {&sweep, 1}, {&hit, 1}).ok());
    EXPECT_EQ(hit.state, ImpactState::hit);
    EXPECT_NEAR(hit.error_bound, of_shape + of_instance, rounding);
}

}  // namespace
}  // namespace nearfield::test
