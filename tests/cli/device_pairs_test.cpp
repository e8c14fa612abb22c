// Hits of all pairs that the device finds.

#include "strip_scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace nearfield::test {
namespace {

class DevicePairs : public StripScene {
protected:
    /// A query of all pairs, hits only, by a technique.
    static std::string hits(const std::string& members, const std::string& technique = "compute") {
        return R"({"pairs": "all", "hits_only": true, "technique": ")" + technique + "\", " +
               members + "}";
    }
};

TEST_F(DevicePairs, AreResultsLikeAnyOther) {
    const Json result = results_of(hits(R"("query": "penetration", "tolerance": 0.1)")).at(0);
    EXPECT_EQ(result.at("status"), "ok");
    EXPECT_EQ(result.at("technique"), "compute");
    EXPECT_TRUE(result.contains("a") && result.contains("b"));
    EXPECT_EQ(result.at("count"), result.at("records").size());
    EXPECT_EQ(result.at("regions"), Json::array());
}

TEST_F(DevicePairs, OfAllPairsThatAreNotHitsABatchIsAsked) {
    const std::string file =
        scene(R"({"query": "intersection-test", "pairs": "all", "technique": "compute"})");
    const Outcome outcome = run_program({"scene", file}, without_driver());
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("does not answer intersection tests"), std::string::npos);
    const std::string hits_alone = scene(hits(R"("query": "intersection-test")"));
    EXPECT_EQ(run_program({"scene", hits_alone}, without_driver()).status, 3);
}

TEST_F(DevicePairs, FramesAreMeasured) {
    const std::string file = scene(hits(R"("query": "intersection-test")", "automatic") + ", " +
                                   hits(R"("query": "contacts", "tolerance": 0.1)", "automatic"));
    const Json json =
        answer({"bench", "--scene", file, "--technique", "compute", "--frames", "2", "--keep"});
    EXPECT_EQ(json.at("technique"), "compute");
    EXPECT_EQ(json.at("pairs"), 15) << "each pair of boxes once, and in both orders";
    EXPECT_TRUE(json.at("timings_ms").at("passes").contains("pair verdicts")) << json;
    // They are answered together, so none has a time of its own.
    const Json timed = answer({"scene", file, "--technique", "compute", "--query-times"});
    for (const Json& result : timed.at("results")) {
        EXPECT_FALSE(result.contains("time_ms")) << result;
    }
}

TEST_F(DevicePairs, ErrorsOfPairsAreThoseOfTheCpu) {
    folder_.write("disc.path", "M 1 0 A 1 1 0 1 1 -1 0 A 1 1 0 1 1 1 0 Z");
    Json scene = strip();
    scene["shapes"]["disc"] = {{"file", "disc.path"}, {"deviation", 0.05}};
    scene["instances"]["i5"] = {{"shape", "disc"}, {"pose", {2.5, 2.5, 0}}};
    const auto outcome_of = [&](const std::string& technique) {
        scene["queries"] = Json::array(
            {Json::parse(hits(R"("query": "penetration", "tolerance": 0.1)", technique))});
        return run_program({"scene", folder_.write("disc.json", scene.dump()), "--json", "-"});
    };
    const Outcome by_cpu = outcome_of("cpu");
    const Outcome by_device = outcome_of("compute");
    EXPECT_EQ(by_device.status, 2);
    EXPECT_EQ(by_device.status, by_cpu.status);
    const auto errors_of = [](const Outcome& outcome) {
        std::vector<Json> errors;
        const Json results = Json::parse(outcome.out).at("results");
        for (const Json& result : results) {
            if (result.at("status") != "ok") {
                errors.push_back(result);
            }
        }
        return errors;
    };
    EXPECT_EQ(errors_of(by_device), errors_of(by_cpu));
    EXPECT_GE(errors_of(by_cpu).size(), 4U);
}

TEST_F(DevicePairs, TooManyAreAnErrorOfTheQuery) {
    Json scene = strip();
    for (int i = 0; i < 500; ++i) {
        scene["instances"]["more" + std::to_string(i)] = {{"shape", "square"}};
    }
    scene["queries"] = Json::array({Json::parse(hits(R"("query": "intersection-test")")),
                                    Json::parse(R"({"query": "overlap", "points": [[9, 3]]})")});
    const Outcome outcome = run_program(
        {"scene", folder_.write("many.json", scene.dump()), "--memory-limit", "1", "--json", "-"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("queries[0]: too_large"), std::string::npos) << outcome.err;
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), 2U);
    EXPECT_TRUE(results.at(0).at("a").is_null());
    EXPECT_EQ(results.at(0).at("status"), "too_large");
    EXPECT_EQ(results.at(1).at("status"), "ok");
}

}  // namespace
}  // namespace nearfield::test
