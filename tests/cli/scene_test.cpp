#include "cli_test.hpp"

#include <gtest/gtest.h>

namespace nearfield::test {
namespace {

class SceneCommand : public CliTest {
protected:
    /// The unit square, a second instance at `pose`, and queries between the two.
    std::string scene(const std::string& queries) const {
        return folder_.write("scene.json", R"({"shapes": {"square": {"file": "a square.geojson"}},
            "instances": {"A": {"shape": "square"}, "B": {"shape": "square", "pose": [0.6, 0.3, 0]},
                          "far": {"shape": "square", "pose": [4, 5, 0]}},
            "queries": [)" + queries + "]}");
    }
    Json answer_of_scene(const std::string& queries) const {
        return answer({"scene", scene(queries)});
    }
};

TEST_F(SceneCommand, AnswersEveryQueryAsTheQueryCommandDoes) {
    const Json json = answer_of_scene(
        R"({"query": "penetration", "a": "A", "b": "B", "tolerance": 0.05},
           {"query": "contacts", "a": "A", "b": "B", "tolerance": 0.05, "contact_distance": 0.1},
           {"query": "separation", "a": "A", "b": "far", "tolerance": 0.05},
           {"query": "closest-point", "a": "far", "b": "B", "tolerance": 0.05},
           {"query": "intersection", "a": "A", "b": "B", "tolerance": 0.05, "records": false},
           {"query": "distance-field", "a": "A", "b": "B", "tolerance": 0.05})");
    ASSERT_TRUE(json.is_object());
    EXPECT_TRUE(json.at("device").is_string());
    EXPECT_TRUE(json.at("timings_ms").at("total").is_number());
    const Json& results = json.at("results");
    ASSERT_EQ(results.size(), 6U);
    EXPECT_EQ(results.at(2).at("a"), "A");
    EXPECT_EQ(results.at(2).at("b"), "far");
    EXPECT_DOUBLE_EQ(results.at(2).at("distance").get<double>(), 5.0);
    EXPECT_TRUE(results.at(4).at("samples").empty());
    EXPECT_GT(results.at(4).at("count").get<int>(), 0);
    for (const char* type : {"penetration", "contacts", "distance-field"}) {
        Arguments arguments =
            squares(type, "automatic") + Arguments{"-d", "0.05", "--pose-b", "0.6,0.3,0"};
        if (std::string(type) == "contacts") {
            arguments = arguments + Arguments{"--contact-distance", "0.1"};
        }
        Json alone = answer(arguments);
        ASSERT_TRUE(alone.is_object());
        Json in_scene;
        for (const Json& result : results) {
            if (result.at("query") == type) {
                in_scene = result;
            }
        }
        in_scene.erase("a");
        in_scene.erase("b");
        EXPECT_EQ(in_scene.at("status"), "ok");
        in_scene.erase("status");
        for (const char* key : {"device", "timings_ms"}) {
            alone.erase(key);
        }
        EXPECT_EQ(in_scene, alone);
    }
}

TEST_F(SceneCommand, WritesTheTimeOfEachQueryIfAskedTo) {
    const std::string file = scene(
        R"({"query": "penetration", "a": "A", "b": "B", "tolerance": 0.05, "technique": "cpu"},
           {"query": "contacts", "a": "A", "b": "nobody", "tolerance": 0.05},
           {"query": "distance-field", "a": "A", "b": "B", "tolerance": 0.05,
            "technique": "compute"})");
    const Outcome outcome = run_program({"scene", file, "--query-times", "--json", "-"});
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), 3U);
    for (const std::size_t answered : {0U, 2U}) {
        const Json& time = results.at(answered).at("time_ms");
        EXPECT_GT(time.at("plan").get<double>(), 0.0);
        EXPECT_GT(time.at("answer").get<double>(), 0.0);
    }
    EXPECT_TRUE(results.at(0).at("time_ms").at("device").is_null());
    EXPECT_GT(results.at(2).at("time_ms").at("device").get<double>(), 0.0);
    EXPECT_FALSE(results.at(1).contains("time_ms"));
}

TEST_F(SceneCommand, AllPairsAreThoseWhoseBoxesMeet) {
    const Json json = answer_of_scene(
        R"({"query": "penetration", "pairs": "all", "tolerance": 0.05, "records": false},
           {"query": "separation", "pairs": "all", "tolerance": 0.05, "reach": 4.5})");
    ASSERT_TRUE(json.is_object());
    std::vector<std::string> pairs;
    for (const Json& result : json.at("results")) {
        pairs.push_back(result.at("query").get<std::string>() + " " +
                        result.at("a").get<std::string>() + " " +
                        result.at("b").get<std::string>());
    }
    // A and `far` are 5 apart, and their boxes at most 4 along either axis.
    EXPECT_EQ(pairs, (std::vector<std::string>{"penetration A B", "penetration B A",
                                               "separation A B", "separation B far"}));
}

TEST_F(SceneCommand, CurvesTakePartInAllPairs) {
    static_cast<void>(folder_.write("disc.path", "M 1 0 A 1 1 0 1 1 -1 0 A 1 1 0 1 1 1 0 Z"));
    const auto scene_of = [&](const std::string& instances) {
        return folder_.write("curves.json",
                             R"({"shapes": {"disc": {"file": "disc.path"}}, "instances": {)" +
                                 instances +
                                 R"(}, "queries": [{"query": "penetration", "pairs": "all",
                                                    "tolerance": 0.1}]})");
    };
    const Json json = answer({"scene", scene_of(R"("left": {"shape": "disc"},
                                                   "right": {"shape": "disc", "pose": [1, 0, 0]})")});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("results").size(), 2U);
    const Outcome unused = run_program({"scene", scene_of("")});
    EXPECT_EQ(unused.status, 2);
    EXPECT_NE(unused.err.find("curves.json: shapes.disc: has curves"), std::string::npos)
        << unused.err;
}

TEST_F(SceneCommand, WithoutQueriesThereAreNoResults) {
    const Json json = answer_of_scene("");
    ASSERT_TRUE(json.is_object());
    EXPECT_TRUE(json.at("results").empty());
}

TEST_F(SceneCommand, BadQueriesAreListedAndTheOthersAnswered) {
    const std::string file = scene(
        R"({"query": "separation", "a": "A", "b": "far"},
           {"query": "distance-field", "a": "A", "b": "far", "tolerance": 0.1},
           {"query": "penetration", "pairs": "some", "tolerance": 1},
           {"query": "separation", "pairs": "all", "tolerance": 1},
           {"query": "contacts", "pairs": "all", "reach": 1, "tolerance": 1},
           {"query": "separation", "a": "A", "b": "nobody", "tolerance": 1},
           {"query": "depth", "a": "A", "b": "B"},
           {"query": "intersection-test", "a": "A", "b": "B"})");
    const std::string out = folder_.path("answers.json");
    const Outcome outcome = run_program({"scene", file, "--json", out});
    EXPECT_EQ(outcome.status, 2);
    for (const char* const part :
         {"scene.json: queries[1]: invalid_query: ", "rectangle", "queries[2].pairs: \"some\"",
          "queries[3]: has no \"reach\"", "queries[4].reach: ",
          "queries[5].b: there is no instance \"nobody\"", "queries[6].query: \"depth\""}) {
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err << "lacks " << part;
    }
    EXPECT_EQ(outcome.err.find("queries[0]"), std::string::npos) << outcome.err;
    const Json results = Json::parse(folder_.read("answers.json")).at("results");
    ASSERT_EQ(results.size(), 8U);
    for (std::size_t i = 0; i < results.size(); ++i) {
        const bool is_good = i == 0 || i == 7;
        EXPECT_EQ(results[i].at("status"), is_good ? "ok" : "invalid_query") << i;
        EXPECT_EQ(results[i].contains("message"), !is_good) << i;
        EXPECT_EQ(results[i].contains("error_bound"), is_good) << i;
    }
    EXPECT_EQ(results[0].at("distance"), 5.0);
    EXPECT_EQ(results[5].at("b"), "nobody");
    EXPECT_EQ(results[6].at("query"), "depth");
    EXPECT_EQ(results[7].at("intersects"), true);
}

TEST_F(SceneCommand, BadShapesAreListedAndTheOthersAnswered) {
    static_cast<void>(folder_.write("flat.wkt", "MULTIPOLYGON(((0 0,1 1,2 2)),((5 5,6 6,7 7)))"));
    const std::string file = folder_.write("scene.json", R"({
        "shapes": {"square": {"file": "a square.geojson"}, "flat": {"file": "flat.wkt"},
                   "gone": {"file": "gone.wkt"}},
        "instances": {"A": {"shape": "square"}, "B": {"shape": "square", "pose": [0.6, 0.3, 0]},
                      "F": {"shape": "flat"}, "G": {"shape": "gone"},
                      "far": {"shape": "square", "pose": [1e13, 0, 0]}},
        "queries": [{"query": "separation", "a": "A", "b": "F", "tolerance": 1},
                    {"query": "separation", "a": "G", "b": "far", "tolerance": 1},
                    {"query": "intersection-test", "pairs": "all"},
                    {"query": "time-of-impact", "pairs": "all", "tolerance": 1}]})");
    const Outcome outcome = run_program({"scene", file, "--json", "-"});
    EXPECT_EQ(outcome.status, 2);
    for (const char* const part :
         {"scene.json: shapes.flat: 2 of 2 rings are bad", "ring 1 from (5, 5) lies on one line",
          "scene.json: shapes.gone: ", "gone.wkt: cannot be opened",
          "scene.json: instances.far: the x of the instance's pose is 1e+13",
          "not answered because of what is listed above: 4 queries"}) {
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err << "lacks " << part;
    }
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), 6U);
    const auto message = [&](std::size_t i) { return results[i].value("message", ""); };
    EXPECT_NE(message(0).find("shapes.flat"), std::string::npos) << message(0);
    EXPECT_NE(message(1).find("shapes.gone"), std::string::npos) << message(1);
    EXPECT_NE(message(1).find("instances.far"), std::string::npos) << message(1);
    for (const std::size_t i : {2U, 4U}) {
        EXPECT_EQ(results[i].at("status"), "ok");
        EXPECT_EQ(results[i].at("a"), "A");
        EXPECT_EQ(results[i].at("b"), "B");
        EXPECT_EQ(results[i].at("intersects"), true);
        // What all pairs lack is said.
        EXPECT_EQ(results[i + 1].at("status"), "invalid_query");
        EXPECT_TRUE(results[i + 1].at("a").is_null());
        EXPECT_NE(message(i + 1).find("F (shapes.flat), G (shapes.gone), far"), std::string::npos)
            << message(i + 1);
    }
}

TEST_F(SceneCommand, InstancesOfNoShapeAreListedWhereThereAreNoShapes) {
    for (const char* const queries :
         {"", R"({"query": "intersection-test", "a": "A", "b": "B"})",
          R"({"query": "separation", "pairs": "all", "tolerance": 1, "reach": 1})",
          R"({"query": "overlap", "points": [[0, 0]]})",
          R"({"query": "nearest", "points": [[0, 0]]})"}) {
        SCOPED_TRACE(queries);
        const std::string file = folder_.write(
            "scene.json", std::string(R"({"shapes": {}, "instances": {"A": {"shape": "none"},
                "B": {"shape": "none"}}, "queries": [)") +
                              queries + "]}");
        const Outcome outcome = run_program({"scene", file, "--json", "-"});
        EXPECT_EQ(outcome.status, 2);
        for (const char* const part : {"instances.A.shape: there is no shape \"none\"",
                                       "instances.B.shape: there is no shape \"none\""}) {
            EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        }
    }
}

TEST_F(SceneCommand, AQueryThatIsTooLargeLeavesTheOthersAnswered) {
    const std::string queries =
        R"({"query": "penetration", "a": "A", "b": "B", "tolerance": 0.05},
           {"query": "penetration", "a": "A", "b": "B", "tolerance": 1e-10},
           {"query": "distance-field", "a": "A", "b": "B", "tolerance": 0.1, "at": [[0.5, 0.5]]})";
    const Outcome outcome = run_program({"scene", scene(queries), "--json", "-"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("queries[1]: too_large: tolerance 1e-10 needs"), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("--memory-limit"), std::string::npos) << outcome.err;
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), 3U);
    EXPECT_EQ(results[1].at("status"), "too_large");
    const Json alone = answer_of_scene(
        R"({"query": "penetration", "a": "A", "b": "B", "tolerance": 0.05},
           {"query": "distance-field", "a": "A", "b": "B", "tolerance": 0.1, "at": [[0.5, 0.5]]})");
    EXPECT_EQ(results[0], alone.at("results")[0]);
    EXPECT_EQ(results[2], alone.at("results")[1]);
}

TEST_F(SceneCommand, WhatIsNoSceneIsRefusedAsAWhole) {
    expect_refused(
        {"scene", scene(R"({"query": "separation", "a": "A", "b": "B", "toleranse": 1})")},
        {"queries[0].toleranse", "is not known here"});
    expect_refused({"scene", folder_.write("cut.json", R"({"shapes": {)")}, {"cut.json:1:"});
    expect_refused({"scene", folder_.write("part.json", R"({"shapes": {}, "instances": {}})")},
                   {"part.json", "queries"});
    expect_refused({"scene"}, {"scene is required"});
    expect_refused({"scene", folder_.path("none.json")}, {"none.json", "cannot be opened"});
    // A measurement is of all queries.
    expect_refused({"bench", "--scene",
                    scene(R"({"query": "separation", "a": "A", "b": "nobody", "tolerance": 1})")},
                   {"queries[0].b", "nobody"});
}

}  // namespace
}  // namespace nearfield::test
