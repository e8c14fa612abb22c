#include <gtest/gtest.h>
#include <tests/support/planned_queries.hpp>
#include <tests/support/polygons.hpp>

#include <vector>

namespace nearfield::queries {
namespace {

class CheckedQueryTest : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(square_.assign(std::vector<Ring>{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}).ok());
    }

    CheckedQuery check_one(const AnyQuery& query) {
        queries_.assign(1, query);
        const std::vector<QueryShapes> shapes{{&square_, &square_}};
        const auto checked = test::checked_queries(queries_, shapes, limits_, results_);
        EXPECT_EQ(checked.size(), 1U);
        return checked.empty() ? CheckedQuery() : checked.front();
    }

    geometry::Polygon square_;
    QueryLimits limits_;
    std::vector<AnyQuery> queries_;
    std::vector<AnyResult> results_;
};

TEST_F(CheckedQueryTest, TheGridOfTheDeviceDecidesNothingThatTheCpuAnswers) {
    IntersectionQuery query;
    query.tolerance = 0.01;
    const auto cell_of = [&](Technique technique, double steps) {
        query.technique = technique;
        limits_.subpixel = {steps};
        return check_one(query).budget.cell;
    };
    EXPECT_EQ(cell_of(Technique::cpu, 16.0), cell_of(Technique::cpu, 4096.0));
    EXPECT_EQ(cell_of(Technique::cpu, 16.0), cell_of(Technique::raster, 256.0));
    EXPECT_LT(cell_of(Technique::raster, 16.0), cell_of(Technique::raster, 256.0));
}

TEST_F(CheckedQueryTest, TheCpuHasWhatTheDeviceDoesNotSearch) {
    PenetrationQuery penetration;
    penetration.technique = Technique::compute;
    penetration.tolerance = 0.01;
    EXPECT_EQ(check_one(penetration).technique, Technique::compute);
    penetration.tolerance = 1e-5;  // more than 2^21 samples
    EXPECT_EQ(check_one(penetration).technique, Technique::cpu);
    EXPECT_EQ(std::get<PenetrationResult>(results_.front()).technique, Technique::compute);
    penetration.points = PenetrationPoints::vertices;
    EXPECT_EQ(check_one(penetration).technique, Technique::compute);
    SeparationQuery separation;
    separation.technique = Technique::compute;
    separation.tolerance = 0.01;
    EXPECT_EQ(check_one(separation).technique, Technique::cpu);
}

TEST_F(CheckedQueryTest, ATechniqueThatTheLibraryWasBuiltWithoutIsRefusedByName) {
    limits_.techniques.has_raster = limits_.techniques.raster = false;
    PenetrationQuery query;
    query.technique = Technique::raster;
    query.tolerance = 0.01;
    queries_.assign(1, query);
    const std::vector<QueryShapes> shapes{{&square_, &square_}};
    EXPECT_TRUE(test::checked_queries(queries_, shapes, limits_, results_).empty());
    const Status& status = std::get<PenetrationResult>(results_.front()).status;
    EXPECT_EQ(status.code(), StatusCode::unsupported_technique);
    EXPECT_NE(status.message().find("built without the technique raster"), std::string::npos)
        << status.text();
}

}  // namespace
}  // namespace nearfield::queries
