#include <engine/device_input/point_search.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nearfield::device_input {
namespace {

using test::Random;
using test::Rings;

/// Two shapes, and a plan of one searched query of them.
class PointSearchInput : public testing::Test {
protected:
    PointSearchInput() {
        query_ = PenetrationQuery{};
        plan_.queries.resize(1);
        PlannedQuery& planned = plan_.queries.front();
        planned.query = &query_;
        planned.a = &a_;
        planned.b = &b_;
        planned.budget.cell = 0.05;
        planned.work.emplace<PlannedPoints>().source = PointSource::device;
    }

    void build(const Rings& a, const Rings& b) {
        ASSERT_TRUE(a_.assign(a).ok());
        ASSERT_TRUE(b_.assign(b).ok());
        build();
    }
    void build() {
        plan_.clear();
        static_cast<void>(builder_.add(0, plan_.queries.front(), geometry::Vector::UnitX(),
                                       geometry::Vector::Zero(), plan_.pairs));
        ASSERT_EQ(search().directions.size(), 1U);
    }

    /// The next build is of other polygons.
    void use(const geometry::Polygon& a, const geometry::Polygon& b) {
        plan_.queries.front().a = &a;
        plan_.queries.front().b = &b;
    }
    void fit(std::uint64_t bytes) { builder_.fit(bytes, plan_); }
    void ask_for_contacts_within(double distance) {
        ContactQuery contacts;
        contacts.contact_distance = distance;
        query_ = contacts;
        plan_.queries.front().points().outside = true;
    }

    [[nodiscard]] std::size_t builder_size() const { return builder_.shapes().units().size(); }
    [[nodiscard]] const GivenPairs& search() const { return plan_.pairs; }

private:
    AnyQuery query_;
    Plan plan_;
    GivenPairsBuilder builder_;

protected:
    geometry::Polygon a_;
    geometry::Polygon b_;
};

TEST_F(PointSearchInput, FollowsShapesThatGrowShrinkAndMove) {
    Random random(19);
    std::size_t largest = 0;
    for (int frame = 0; frame < 400; ++frame) {
        SCOPED_TRACE(frame);
        build(test::star(random, random.whole(3, 300), 0.3), test::regular(random.whole(3, 40)));
        largest = std::max(largest, builder_size());
    }
    // No more is left behind than a few times what is in use.
    EXPECT_LT(largest, 4096U + 4 * 2 * 2 * (300 + 40));
}

TEST_F(PointSearchInput, ForgetsShapesThatAreNoLongerUsed) {
    Random random(20);
    std::vector<geometry::Polygon> polygons(300);
    for (geometry::Polygon& polygon : polygons) {
        ASSERT_TRUE(polygon.assign(test::star(random, 100, 0.3)).ok());
    }
    std::size_t largest = 0;
    for (std::size_t frame = 1; frame < polygons.size(); ++frame) {
        use(polygons[frame - 1], polygons[frame]);
        build();
        largest = std::max(largest, builder_size());
    }
    // A shape of 100 edges takes less than 100 units for edges and boxes, and 50 for its samples.
    EXPECT_LT(largest, 4096U + 5 * 4 * 150);
}

TEST_F(PointSearchInput, ForgetsEarlierShapesWhereAllTakeTooMuch) {
    Random random(24);
    std::vector<geometry::Polygon> polygons(2);
    for (geometry::Polygon& polygon : polygons) {
        ASSERT_TRUE(polygon.assign(test::star(random, 100, 0.3)).ok());
        use(polygon, polygon);
        build();
    }
    const std::size_t of_both = builder_size();
    fit(of_both * sizeof(SearchUnit));
    EXPECT_EQ(builder_size(), of_both);
    fit(of_both * sizeof(SearchUnit) - 1);
    EXPECT_EQ(builder_size(), of_both / 2);
}

TEST_F(PointSearchInput, ReachesTheContactDistance) {
    Random random(21);
    for (int i = 0; i < 100; ++i) {
        const double distance = random.between(1e-3, 2.0);
        ask_for_contacts_within(distance);
        build(test::star(random, 20, 0.3), test::star(random, 20, 0.3));
        const double unit = std::ldexp(1.0, std::ilogb(b_.radius()));
        EXPECT_GE(static_cast<double>(search().directions.front().reach) * unit, distance);
        EXPECT_LE(static_cast<double>(search().directions.front().reach) * unit,
                  distance * (1.0 + 1e-6));
    }
}

TEST_F(PointSearchInput, MarginCoversSixteenRoundings) {
    Random random(22);
    for (int i = 0; i < 100; ++i) {
        build(test::star(random, 20, 0.3), test::star(random, 20, 0.3));
        const double unit = std::ldexp(1.0, std::ilogb(b_.radius()));
        const double extent = a_.radius() + b_.radius();  // the centres coincide
        const double rounding = std::ldexp(extent, -24);
        EXPECT_GE(static_cast<double>(search().directions.front().margin) * unit, 16.0 * rounding);
        EXPECT_LE(static_cast<double>(search().directions.front().margin) * unit, 17.0 * rounding);
    }
}

}  // namespace
}  // namespace nearfield::device_input
