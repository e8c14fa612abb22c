#include <gtest/gtest.h>
#include <tools/cli/bench.hpp>
#include <tools/simulation/rigid_body.hpp>
#include <tools/simulation/scene.hpp>

#include <memory>
#include <string>
#include <utility>

namespace nearfield::tools {
namespace {

TechniqueTime time_of(const std::string& technique, double milliseconds) {
    TechniqueTime time;
    time.technique = technique;
    time.frame_ms.median = milliseconds;
    return time;
}

TEST(RowTimes, CompareAutomaticWithTheBestOfTheOthers) {
    RowTimes row{"row", {time_of("raster", 8.0), time_of("compute", 4.0), time_of("cpu", 5.0)}};
    EXPECT_FALSE(row.automatic_to_best().has_value());
    row.techniques.push_back(time_of("automatic", 6.0));
    EXPECT_EQ(row.automatic_to_best(), 1.5);
    row.techniques.back().frame_ms.median = 2.0;
    EXPECT_EQ(row.automatic_to_best(), 0.5) << "quicker than the best of the others";
    row.techniques[1].refusal = "no device";
    EXPECT_EQ(row.automatic_to_best(), 0.4);
}

/// A wheel in the corner of a square's box, which it does not touch: two queries in every frame.
simulation::Scene wheel_beside_square() {
    simulation::Scene scene;
    const Ring wheel{{1, 0}, {0.7, 0.7}, {0, 1}, {-0.7, 0.7}, {-1, 0}, {0, -1}};
    const Ring square{{0.8, 0.8}, {1.8, 0.8}, {1.8, 1.8}, {0.8, 1.8}};
    scene.bodies.push_back(std::make_unique<simulation::RigidBody>(std::vector<Ring>{wheel}, Pose{},
                                                                   simulation::Freedom::turning));
    scene.bodies.push_back(std::make_unique<simulation::RigidBody>(
        std::vector<Ring>{square}, Pose{}, simulation::Freedom::directed));
    scene.tolerance = 0.05;
    return scene;
}

TEST(QueryStopwatch, CountsTheQueriesOfAFrame) {
    QueryStopwatch stopwatch{Settings{}};
    const QueryTimes still = stopwatch.measure_still(wheel_beside_square());
    EXPECT_EQ(still.queries, 2.0);
    EXPECT_EQ(still.points, 0.0);
    const std::vector<QueryTimes> moving =
        stopwatch.measure_run(wheel_beside_square(), {0.1, 0.05});
    ASSERT_EQ(moving.size(), 2U);
    for (const QueryTimes& times : moving) {
        EXPECT_EQ(times.queries, 2.0);
        EXPECT_EQ(times.points, 0.0);
        for (const std::optional<double>& milliseconds : times.milliseconds) {
            EXPECT_GT(milliseconds.value_or(0.0), 0.0);
        }
    }
}

}  // namespace
}  // namespace nearfield::tools
