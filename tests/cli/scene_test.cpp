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
        for (const char* key : {"device", "timings_ms"}) {
            alone.erase(key);
        }
        EXPECT_EQ(in_scene, alone);
    }
}

TEST_F(SceneCommand, FindsTheSameWithSeveralThreads) {
    std::string queries;
    for (const char* tolerance : {"0.01", "0.02", "0.03", "0.04", "0.05"}) {
        queries +=
            std::string(queries.empty() ? "" : ", ") +
            R"({"query": "contacts", "a": "A", "b": "B", "technique": "cpu", "tolerance": )" +
            tolerance + "}";
    }
    const Json alone = answer_of_scene(queries);
    ASSERT_TRUE(alone.is_object());
    ASSERT_EQ(alone.at("results").size(), 5U);
    for (const char* threads : {"1", "3"}) {
        const Json together = answer({"scene", scene(queries), "--threads", threads});
        ASSERT_TRUE(together.is_object());
        EXPECT_EQ(together.at("results"), alone.at("results"));
    }
    expect_refused({"scene", scene(queries), "--threads", "0"}, {"--threads"});
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
    expect_refused({"scene", scene_of("")}, {"curves.json", "disc", "deviation"});
}

TEST_F(SceneCommand, WithoutQueriesThereAreNoResults) {
    const Json json = answer_of_scene("");
    ASSERT_TRUE(json.is_object());
    EXPECT_TRUE(json.at("results").empty());
}

TEST_F(SceneCommand, NamesTheQueryThatIsRefused) {
    expect_refused({"scene", scene(R"({"query": "separation", "a": "A", "b": "B", "tolerance": 0.1},
                        {"query": "distance-field", "a": "A", "b": "far", "tolerance": 0.1})")},
                   {"scene.json", "queries[1]", "rectangle"});
    expect_refused({"scene", scene(R"({"query": "penetration", "pairs": "some", "tolerance": 1})")},
                   {"queries[0].pairs", "some", "all"});
    expect_refused({"scene", scene(R"({"query": "separation", "pairs": "all", "tolerance": 1})")},
                   {"queries[0]", "reach"});
    expect_refused(
        {"scene", scene(R"({"query": "contacts", "pairs": "all", "reach": 1, "tolerance": 1})")},
        {"queries[0].reach"});
    expect_refused({"scene"}, {"scene is required"});
    expect_refused({"scene", folder_.path("none.json")}, {"none.json", "cannot be opened"});
}

}  // namespace
}  // namespace nearfield::test
