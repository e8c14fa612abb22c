#include <engine/solvers/found_contacts.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <vector>

namespace nearfield::solvers {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// A square on a square, 0.25 apart, with two contacts of each.
class FoundContactsTest : public testing::Test {
protected:
    FoundContactsTest()
        : a_(samples::polygon({samples::rectangle(-1.0, 0.25, 1.0, 2.25)})),
          b_(samples::polygon({samples::rectangle(-1.0, -2.0, 1.0, 0.0)})) {
        boundary_of_b_.set(geometry::TransformedPolygon(b_, {}));
        contacts_.begin(0.1, 1e-15);
        for (const double x : {-0.5, 0.5}) {
            ResolvedPoint on_a;
            on_a.point = {x, 0.25};
            on_a.nearest = {x, 0.0};
            on_a.distance = 0.25;
            on_a.edge = 2;
            on_a.feature = {Feature::Kind::edge, 2};
            contacts_.add_of_a({0, 0.5 + 0.5 * x}, on_a,
                               [&]() -> narrowphase::Boundary& { return boundary_of_b_; });
        }
        for (const double x : {-0.5, 0.5}) {
            ResolvedPoint on_b;
            on_b.point = {x, 0.0};
            on_b.nearest = {x, 0.25};
            on_b.distance = 0.25;
            on_b.edge = 0;
            on_b.parameter = 0.5 + 0.5 * x;
            on_b.feature = {Feature::Kind::edge, 0};
            contacts_.add_of_b({2, 0.5 - 0.5 * x}, on_b, boundary_of_b_);
        }
        contacts_.decide_normals([&]() -> narrowphase::Boundary& { return boundary_of_b_; });
    }

    std::vector<ContactPoint> written() {
        ContactResult result;
        result.cell = 0.1;
        contacts_.write(a_, b_, ContactQuery{}, result);
        EXPECT_EQ(result.count, result.points.size());
        return result.points;
    }

    Polygon a_;
    Polygon b_;
    narrowphase::Boundary boundary_of_b_;
    FoundContacts contacts_;
};

TEST_F(FoundContactsTest, NormalsAreAnalyticAndUniqueAsFound) {
    const std::vector<ContactPoint> records = written();
    ASSERT_EQ(records.size(), 4U);
    for (const ContactPoint& record : records) {
        EXPECT_EQ(record.normal, (Vector2{0.0, 1.0}));
        EXPECT_TRUE(record.unique);
    }
}

TEST_F(FoundContactsTest, AGradientGivesTheNormalItsDirection) {
    const std::vector<Vector2> gradients{{0.6, 0.8}, {0.0, 0.5}, {-0.003, 0.004}, {1.0, 0.0}};
    contacts_.set_normals(gradients);
    const std::vector<Vector2> normals{{0.6, 0.8}, {0.0, 1.0}, {-0.6, 0.8}, {1.0, 0.0}};
    const std::vector<ContactPoint> records = written();
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(records[i].normal.x, normals[i].x, 1e-15) << i;
        EXPECT_NEAR(records[i].normal.y, normals[i].y, 1e-15) << i;
        EXPECT_TRUE(records[i].unique) << i;
    }
}

TEST_F(FoundContactsTest, WhereTheGradientVanishesTheNormalStaysAndIsOneOfSeveral) {
    // Between walls, on the medial axis: of A's second contact and B's first.
    const std::vector<Vector2> gradients{{0.6, 0.8}, {0.0, 1e-4}, {0.0, 0.0}, {0.0, 2e-3}};
    contacts_.set_normals(gradients);
    const std::vector<ContactPoint> records = written();
    EXPECT_TRUE(records[0].unique);
    EXPECT_FALSE(records[1].unique);
    EXPECT_EQ(records[1].normal, (Vector2{0.0, 1.0}));
    EXPECT_FALSE(records[2].unique);
    EXPECT_EQ(records[2].normal, (Vector2{0.0, 1.0}));
    EXPECT_TRUE(records[3].unique);
}

}  // namespace
}  // namespace nearfield::solvers
