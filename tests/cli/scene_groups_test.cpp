#include "strip_scene.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

class SceneGroups : public StripScene {
protected:
    /// "a b" of each result.
    std::vector<std::string> pairs_of(const std::string& query) const {
        std::vector<std::string> pairs;
        for (const Json& result : results_of(query)) {
            EXPECT_EQ(result.at("status"), "ok") << result;
            pairs.push_back(result.at("a").get<std::string>() + " " +
                            result.at("b").get<std::string>());
        }
        return pairs;
    }
};

using Pairs = std::vector<std::string>;

TEST_F(SceneGroups, PairsBetweenGroupsOrInstances) {
    const std::string test = R"({"query": "intersection-test", "pairs": {"between": )";
    // The boxes of all items meet the bin's.
    EXPECT_EQ(pairs_of(test + R"(["items", "bin"]}})"),
              (Pairs{"i1 bin", "i2 bin", "i3 bin", "i4 bin"}));
    EXPECT_EQ(pairs_of(test + R"(["bin", "items"]}})"),
              (Pairs{"bin i1", "bin i2", "bin i3", "bin i4"}));
    EXPECT_EQ(pairs_of(test + R"(["items", "items"]}})"), (Pairs{"i1 i2"}));
    EXPECT_EQ(pairs_of(test + R"(["i2", "i1"]}})"), (Pairs{"i2 i1"}));
    EXPECT_EQ(pairs_of(test + R"(["i3", "i3"]}})"), Pairs{});
    // Groups with members in common: each pair once.
    EXPECT_EQ(pairs_of(test + R"(["placed", "items"]}})"),
              (Pairs{"bin i1", "bin i2", "bin i3", "bin i4", "i1 i2"}));
}

TEST_F(SceneGroups, OrderedKindsAskBothOrders) {
    EXPECT_EQ(pairs_of(R"({"query": "penetration", "pairs": {"between": ["i2", "placed"]},
                           "tolerance": 0.05, "records": false})"),
              (Pairs{"bin i2", "i2 bin", "i1 i2", "i2 i1"}));
    EXPECT_EQ(pairs_of(R"({"query": "separation", "pairs": {"between": ["i4", "items"]},
                           "reach": 5})"),
              (Pairs{"i4 i3"}));
}

TEST_F(SceneGroups, MovingPairsBetweenGroups) {
    Json scene = strip();
    scene["instances"]["i3"]["end_pose"] = {8.6, 1, 0};
    scene["queries"] = Json::parse(
        R"([{"query": "time-of-impact", "pairs": {"between": ["i3", "items"]}, "tolerance": 0.001,
             "hits_only": true}])");
    const Json results =
        answer({"scene", folder_.write("moving.json", scene.dump())}).at("results");
    ASSERT_EQ(results.size(), 1U);
    EXPECT_EQ(results.at(0).at("a"), "i3");
    EXPECT_EQ(results.at(0).at("b"), "i4");
    EXPECT_EQ(results.at(0).at("state"), "hit");
}

TEST_F(SceneGroups, HitsOnlyLeavesOutWhatIsApart) {
    const auto hits_of = [&](const std::string& members) {
        return pairs_of(R"({"pairs": "all", "hits_only": true, )" + members + "}");
    };
    EXPECT_EQ(hits_of(R"("query": "intersection-test")"), (Pairs{"bin i4", "i1 i2"}));
    EXPECT_EQ(hits_of(R"("query": "penetration", "points": "vertices", "tolerance": 0.1)"),
              (Pairs{"i4 bin", "i1 i2", "i2 i1"}))
        << "no vertex of the bin is in i4";
    EXPECT_EQ(hits_of(R"("query": "separation", "reach": 9)"), (Pairs{"bin i4", "i1 i2"}));
    EXPECT_EQ(hits_of(R"("query": "contacts", "tolerance": 0.1, "technique": "cpu")"),
              (Pairs{"bin i4", "i4 bin", "i1 i2", "i2 i1"}));
    EXPECT_EQ(hits_of(R"("query": "intersection", "tolerance": 0.1, "technique": "cpu")"),
              (Pairs{"bin i4", "i4 bin", "i1 i2", "i2 i1"}));
    EXPECT_EQ(hits_of(R"("query": "separation-vector", "tolerance": 0.1)"),
              (Pairs{"bin i4", "i1 i2"}));
    EXPECT_EQ(
        pairs_of(R"({"pairs": "all", "hits_only": false, "query": "intersection-test"})").size(),
        5U);
}

TEST_F(SceneGroups, OfContainmentTheHitsAreInside) {
    Json scene = strip();
    scene["shapes"]["speck"] = {{"rings", {{{0, 0}, {0.25, 0}, {0, 0.25}}}}};
    scene["instances"]["within"] = {{"shape", "speck"}, {"pose", {1.1, 1.1, 0}}};
    scene["instances"]["across"] = {{"shape", "speck"}, {"pose", {3.9, 1.1, 0}}};
    scene["queries"] =
        Json::parse(R"([{"query": "containment", "pairs": "all", "hits_only": true}])");
    const Json results = answer({"scene", folder_.write("scene.json", scene.dump())}).at("results");
    ASSERT_EQ(results.size(), 1U) << results;
    EXPECT_EQ(results.at(0).at("a"), "within");
    EXPECT_EQ(results.at(0).at("b"), "i1");
}

TEST_F(SceneGroups, BadGroupsAndPairsAreNamed) {
    Json scene = strip();
    scene["groups"] = Json::parse(R"({
        "good": ["i1", "i2"], "i1": ["i2"], "twice": ["i1", "i1"], "who": ["i1", "me"],
        "text": "i1", "number": [1]})");
    scene["queries"] = Json::parse(R"([
        {"query": "intersection-test", "pairs": {"between": ["good", "who"]}},
        {"query": "nearest", "points": [[0, 0]], "against": "nobody"},
        {"query": "intersection-test", "pairs": {"between": ["good"]}},
        {"query": "intersection-test", "pairs": {"between": "good"}},
        {"query": "intersection-test", "pairs": 3},
        {"query": "intersection-test", "a": "i1", "b": "i2", "hits_only": true},
        {"query": "intersection-test", "pairs": "all", "hits_only": 1},
        {"query": "intersection-test", "pairs": {"between": ["good", "good"]}}])");
    const Outcome outcome =
        run_program({"scene", folder_.write("scene.json", scene.dump()), "--json", "-"});
    EXPECT_EQ(outcome.status, 2);
    for (const char* const part :
         {"groups.i1: is also the name of an instance", "groups.twice: names \"i1\" twice",
          "groups.who[1]: there is no instance \"me\"", "groups.text: not an array but a string",
          "groups.number[0]: not a string but a number",
          "queries[0].pairs.between[1]: groups.who[1]: there is no instance \"me\"",
          "queries[1].against: there is no group or instance \"nobody\"",
          "queries[2].pairs.between: expected [GROUP, GROUP]",
          "queries[3].pairs.between: not an array but a string",
          "queries[4].pairs: not a string but a number", "queries[5].hits_only: belongs to",
          "queries[6].hits_only: neither true nor false"}) {
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err << "lacks " << part;
    }
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(results[i].at("status"), i == 7 ? "ok" : "invalid_query") << i;
    }
    EXPECT_FALSE(results[1].contains("a"));
    scene["queries"] =
        Json::parse(R"([{"query": "intersection-test", "pairs": {"betwixt": ["good", "good"]}}])");
    expect_refused({"scene", folder_.write("scene.json", scene.dump())},
                   {"queries[0].pairs.betwixt", "is not known here"});
}

}  // namespace
}  // namespace nearfield::test
