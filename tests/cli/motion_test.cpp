#include "cli_test.hpp"
#include "contract.hpp"

namespace nearfield::test {
namespace {

class TimeOfImpactCommand : public CliTest {
protected:
    [[nodiscard]] Arguments moving(const std::string& end) const {
        return squares("time-of-impact", "automatic") +
               Arguments{"-d", "1e-6", "--pose-a", "-3,0.5,0", "--end-pose-a", end};
    }
};

TEST_F(TimeOfImpactCommand, SaysWhenTheShapesFirstTouch) {
    // The unit square's right side, initially at x = -2, is at x = 0 after 2 of 4 units.
    const Json json = answer(moving("1,0.5,0"));
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("query"), "time-of-impact");
    EXPECT_EQ(json.at("state"), "hit");
    EXPECT_EQ(json.at("technique"), "cpu");
    EXPECT_EQ(json.at("intersects"), true);
    EXPECT_NEAR(json.at("time").get<double>(), 0.5, 1e-6);
    EXPECT_LE(json.at("time").get<double>(), 0.5);
    EXPECT_LE(json.at("time_error_bound").get<double>(), 1e-6);
    EXPECT_NEAR(json.at("pose_a").at("translation").at(0).get<double>(), -1.0, 1e-5);
    EXPECT_NEAR(json.at("direction").at(0).get<double>(), 1.0, 1e-9);
    for (const char* key : {"distance", "least_distance", "steps", "tolerance", "error_bound"}) {
        expect_number(json, key);
    }
    EXPECT_FALSE(json.contains("cell"));
}

TEST_F(TimeOfImpactCommand, SaysWhyThereIsNoTime) {
    EXPECT_EQ(answer(moving("-2.5,0.5,0")).at("state"), "separated");
    EXPECT_EQ(answer(moving("1,0.5,0") + Arguments{"--most-steps", "1"}).at("state"),
              "bound-not-reached");
    EXPECT_EQ(answer(squares("time-of-impact", "cpu") + Arguments{"-d", "0.1"}).at("state"),
              "intersecting-at-start");
}

TEST_F(TimeOfImpactCommand, TakesADistanceThatCountsAsTouching) {
    const Json json = answer(moving("1,0.5,0") + Arguments{"--contact-distance", "0.5"});
    EXPECT_EQ(json.at("state"), "hit");
    EXPECT_NEAR(json.at("time").get<double>(), 0.375, 1e-6);
    EXPECT_NEAR(json.at("distance").get<double>(), 0.5, 1e-6);
    expect_refused(moving("1,0.5,0") + Arguments{"--contact-distance", "-1"},
                   {"--contact-distance"});
}

TEST_F(TimeOfImpactCommand, KeepsWholeTurns) {
    const Json json = answer(moving("-3,0.5,720"));
    EXPECT_NEAR(json.at("pose_a").at("degrees").get<double>(), 720.0, 1e-9);
}

TEST_F(TimeOfImpactCommand, RefusesWhatItCannotUse) {
    expect_refused(moving("1,0.5"), {"--end-pose-a", "X,Y,DEGREES"});
    expect_refused(moving("1,0.5,0") + Arguments{"--time-bound", "2"}, {"time bound", "2"});
}

TEST_F(TimeOfImpactCommand, MovesTheInstancesOfAScene) {
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1], [0, 1]]]}},
        "instances": {"A": {"shape": "square", "end_pose": [8, 0, 0]},
                      "B": {"shape": "square", "pose": [3, 0.5, 0]}},
        "queries": [{"query": "time-of-impact", "a": "A", "b": "B", "tolerance": 1e-6},
                    {"query": "separation-vector", "pairs": "all", "tolerance": 0.1,
                     "most_work": 1000}]})");
    const Json json = answer({"scene", scene});
    ASSERT_TRUE(json.is_object());
    ASSERT_EQ(json.at("results").size(), 1U);
    EXPECT_NEAR(json.at("results").at(0).at("time").get<double>(), 0.25, 1e-6);
}

TEST_F(TimeOfImpactCommand, AsksAllPairsOfASceneThatMayMeetOnTheWay) {
    // A moves past B to the right; C moves up, D turns beside it; E is far from all paths.
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1], [0, 1]]]},
                   "bar": {"rings": [[[0, 0], [3, 0], [3, 0.5], [0, 0.5]]]}},
        "instances": {"A": {"shape": "square", "end_pose": [8, 0, 0]},
                      "B": {"shape": "square", "pose": [3, 0.5, 0]},
                      "C": {"shape": "square", "pose": [20, 0, 0], "end_pose": [20, 4, 0]},
                      "D": {"shape": "bar", "pose": [18, 4, 180], "end_pose": [18, 4, 0]},
                      "E": {"shape": "square", "pose": [3, 9, 0]}},
        "queries": [{"query": "time-of-impact", "pairs": "all", "tolerance": 1e-6},
                    {"query": "time-of-impact", "pairs": "all", "tolerance": 1e-6,
                     "contact_distance": 7.75}]})");
    const Json json = answer({"scene", scene});
    ASSERT_TRUE(json.is_object());
    const Json& results = json.at("results");
    ASSERT_GE(results.size(), 3U);
    const auto is_of = [&](std::size_t index, const char* a, const char* b) {
        return results.at(index).at("a") == a && results.at(index).at("b") == b;
    };
    ASSERT_TRUE(is_of(0, "A", "B"));
    EXPECT_NEAR(results.at(0).at("time").get<double>(), 0.25, 1e-6);
    ASSERT_TRUE(is_of(1, "C", "D"));
    EXPECT_EQ(results.at(1).at("state"), "hit");
    // The second query starts here: B and E are 7.5 apart.
    ASSERT_TRUE(is_of(2, "A", "B"));
    EXPECT_NEAR(results.at(2).at("distance").get<double>(), 2.0, 1e-9);
    bool far = false;
    for (std::size_t i = 2; i < results.size(); ++i) {
        far = far || (is_of(i, "B", "E") && results.at(i).at("state") == "intersecting-at-start");
    }
    EXPECT_TRUE(far);
}

/// Two vertices come to the same place at the end, up to rounding: boxes must not lose the pair.
TEST_F(TimeOfImpactCommand, AsksPairsThatOnlyTouchAtTheEnd) {
    const auto results_of = [this](const std::string& pair) {
        return answer({"scene", folder_.write("scene.json", R"({
            "shapes": {"still": {"rings": [[[8, 2], [3, 1], [-1, 2]]]},
                       "moving": {"rings": [[[0, 0], [8, 0], [7, 1]]]}},
            "instances": {"A": {"shape": "still", "pose": [26, 4, 0]},
                          "B": {"shape": "moving", "pose": [60, 7, 180],
                                "end_pose": [41, 7, 180]}},
            "queries": [{"query": "time-of-impact", "tolerance": 1e-6, )" +
                                                                pair + "}]}")})
            .at("results");
    };
    const Json alone = results_of(R"("a": "A", "b": "B")");
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(alone.at(0).at("state"), "hit");
    EXPECT_EQ(results_of(R"("pairs": "all")"), alone);
}

class SeparationVectorCommand : public CliTest {};

TEST_F(SeparationVectorCommand, SaysHowFarToGo) {
    const Arguments query =
        squares("separation-vector", "automatic") + Arguments{"-d", "0.01", "--pose-b"};
    Json json = answer(query + Arguments{"0.75,0.1,0"});
    ASSERT_TRUE(json.is_object());
    EXPECT_NEAR(json.at("vector").at(0).get<double>(), -0.25, 1e-9);
    EXPECT_NEAR(json.at("vector").at(1).get<double>(), 0.0, 1e-9);
    EXPECT_NEAR(json.at("length").get<double>(), 0.25, 1e-9);
    EXPECT_GE(json.at("lower_bound").get<double>(), 0.24);
    EXPECT_EQ(json.at("intersects"), true);
    json = answer(query + Arguments{"1.75,0.1,0"});
    EXPECT_EQ(json.at("length"), 0.0);
    EXPECT_EQ(json.at("intersects"), false);
    json = answer(query + Arguments{"0.75,0.1,0", "--most-work", "1"});
    EXPECT_NEAR(json.at("length").get<double>(), 0.25, 1e-9);
    EXPECT_EQ(json.at("lower_bound"), 0.0);
    EXPECT_LT(json.at("work").get<double>(), 10'000.0);
}

}  // namespace
}  // namespace nearfield::test
