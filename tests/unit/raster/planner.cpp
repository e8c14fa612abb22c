#include <engine/base/status_exception.hpp>
#include <engine/device_input/planner.hpp>
#include <engine/raster/point_planner.hpp>

#include <gtest/gtest.h>
#include <tests/support/planned_queries.hpp>
#include <tests/support/polygons.hpp>

#include <vector>

namespace nearfield::device_input {
namespace {

using geometry::Polygon;

class PlannerTest : public testing::Test {
protected:
    void SetUp() override {
        const std::vector<Ring> a{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
        const std::vector<Ring> b{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
        ASSERT_TRUE(a_.assign(a).ok());
        ASSERT_TRUE(b_.assign(b).ok());
        limits_.memory = 64U << 20U;
        penetration_.a.shape = {0, 0};
        penetration_.b = {{1, 0}, {{6.0, 3.0}, 0.3}};
        penetration_.tolerance = 0.01;
        penetration_.technique = Technique::raster;
    }

    void run(std::vector<AnyQuery> queries) {
        queries_ = std::move(queries);
        std::vector<queries::QueryShapes> shapes;
        queries::find_shapes(
            queries_,
            [this](ShapeHandle handle) -> const Polygon* {
                return handle.index == 0 ? &a_ : handle.index == 1 ? &b_ : nullptr;
            },
            shapes);
        checked_ = test::checked_queries(queries_, shapes, limits_, results_);
        raster::PointPlanner points;
        const auto plan_drawn = [&](CurrentQuery& current, AnyResult& result) {
            points.plan(current, result);
        };
        Planner planner(limits_);
        test::plan_all(checked_, plan_drawn, planner, plan_, results_);
    }

    Polygon a_;
    Polygon b_;
    queries::QueryLimits limits_;
    PenetrationQuery penetration_;
    std::vector<AnyQuery> queries_;
    std::vector<queries::CheckedQuery> checked_;
    Plan plan_;
    std::vector<AnyResult> results_;
};

TEST_F(PlannerTest, LimitsAreToldInUnitsInWhichTheyAreNotZero) {
    IntersectionQuery query{.a = penetration_.a, .b = penetration_.b, .tolerance = 1e-5};
    query.technique = Technique::raster;
    const auto refusal = [&](std::uint64_t memory) -> std::string {
        limits_.memory = memory;
        try {
            run({query});
        } catch (const StatusException& failure) {
            return failure.status().message();
        }
        return "planned";
    };
    const auto says = [](const std::string& message, const std::string& part) {
        return message.find(part) != std::string::npos;
    };
    for (const auto& [memory, told] :
         {std::pair{(64ULL << 20U) + 1, "64 MiB; the smallest"},
          std::pair{1ULL << 20U, "1 MiB; images take all of it"},
          std::pair{(1ULL << 20U) - 1, "1023 KiB; images"}, std::pair{1ULL << 10U, "1 KiB; images"},
          std::pair{1023ULL, "1023 bytes; images"}}) {
        const std::string message = refusal(memory);
        EXPECT_TRUE(says(message, std::string(", more than the limit of ") + told)) << message;
    }
    // What is needed is rounded up, and never told as less than the limit.
    query.tolerance = 0.5;
    const std::string message = refusal(1U << 20U);
    EXPECT_TRUE(says(message, "needs up to 4 MiB, more than the limit of 1 MiB; images"))
        << message;
}

TEST_F(PlannerTest, ResidentSamplesAreGivenAllTheRoomOfTheBufferButTheSummarys) {
    IntersectionQuery query{.a = penetration_.a, .b = penetration_.b, .tolerance = 0.1};
    query.technique = Technique::compute;
    query.on_device = query.samples_on_device = true;
    const auto status_with_room = [&](double cells, std::uint64_t less) {
        limits_.largest_range = sizeof(IntersectionSummaryData) +
                                static_cast<std::uint64_t>(cells) * sizeof(IntersectionSampleData) -
                                less;
        run({query});
        return std::get<IntersectionResult>(results_.front()).status;
    };
    const Status refused = status_with_room(100.0, 0);  // the shapes alone fit
    ASSERT_EQ(refused.code(), StatusCode::too_large);
    const auto at = refused.message().find("has ");
    ASSERT_NE(at, std::string::npos) << refused.message();
    const double cells = std::stod(refused.message().substr(at + 4));
    ASSERT_GT(cells, 100.0);
    EXPECT_TRUE(status_with_room(cells, 0).ok());
    EXPECT_EQ(status_with_room(cells, 1).code(), StatusCode::too_large);
}

TEST_F(PlannerTest, BoundariesMeetWhereBothAreGrownByTheBound) {
    IntersectionQuery query{.a = penetration_.a, .b = {{1, 0}, {}}, .tolerance = 0.01};
    query.technique = Technique::raster;
    query.kind = IntersectionKind::boundary_boundary;
    const auto tiles_at = [&](double gap) {
        query.b.pose.translation = {10.0 + gap, 0.0};
        run({query});
        EXPECT_TRUE(std::get<IntersectionResult>(results_.front()).status.ok());
        return plan_.tiles.size();
    };
    ASSERT_GT(tiles_at(0.0), 0U);
    const double bound = std::get<IntersectionResult>(results_.front()).error_bound;
    EXPECT_GT(tiles_at(1.99 * bound), 0U);
    EXPECT_EQ(tiles_at(2.01 * bound), 0U);
}

TEST_F(PlannerTest, PointsThatTheDeviceSearchesCountOnceTheyAreFound) {
    penetration_.technique = Technique::compute;
    penetration_.b.pose = {{1.0, 1.0}, 0.0};
    constexpr std::size_t many = 10'000;
    run(std::vector<AnyQuery>(many, penetration_));
    EXPECT_EQ(plan_.pairs.directions.size(), many);
    EXPECT_TRUE(plan_.tiles.empty());
    EXPECT_EQ(plan_.result_bytes, 0.0);
}

}  // namespace
}  // namespace nearfield::device_input
