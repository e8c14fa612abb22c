#include "strip_scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using WorldTechniques = StripScene;

/// What the device answers, each query with `more` members.
std::string answered_by_device(const std::string& more) {
    return R"({"query": "poses", "shape": "square", "against": "placed",
               "poses": [[2.5, 1, 0], [4.5, 1, 0], [8, 3.5, 0]])" +
           more + R"(}, {"query": "nearest", "points": [[2.5, 2.5], [4.5, 1.75]])" + more +
           R"(}, {"query": "nearest", "points": [[2.5, 2.5]], "kind": "edges")" + more +
           R"(}, {"query": "rays", "except": "bin", "segments": [[0.5, 1.25, 5.5, 1.25]])" + more +
           "}";
}

/// What the scene's results say apart from the technique.
Json without_technique(Json results) {
    for (Json& result : results) {
        result.erase("technique");
    }
    return results;
}

TEST_F(WorldTechniques, TheDeviceAnswersWhatTheSceneRequests) {
    const std::string file = scene(answered_by_device(R"(, "technique": "compute")") + ", " +
                                   R"({"query": "overlap", "points": [[1.75, 1.75]]})");
    const Json json = answer({"scene", file});
    ASSERT_TRUE(json.is_object());
    EXPECT_FALSE(json.at("device").is_null());
    EXPECT_EQ(json.at("technique"), "mixed");
    const Json& results = json.at("results");
    ASSERT_EQ(results.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(results.at(i).at("technique"), i < 4 ? "compute" : "cpu") << i;
    }
    for (const char* const pass : {"pose tests", "nearest instances", "first hits"}) {
        EXPECT_TRUE(json.at("timings_ms").at("passes").contains(pass)) << json.at("timings_ms");
    }
    for (const char* const technique : {"cpu", "automatic"}) {
        const Json other = answer({"scene", file, "--technique", technique});
        ASSERT_TRUE(other.is_object());
        EXPECT_EQ(other.at("technique"), "cpu");
        EXPECT_EQ(without_technique(other.at("results")), without_technique(results));
    }
}

TEST_F(WorldTechniques, TheOptionSetsThatOfAllQueries) {
    const std::string file = scene(answered_by_device(R"(, "technique": "cpu")"));
    EXPECT_TRUE(answer({"scene", file}).at("device").is_null());
    EXPECT_EQ(answer({"scene", file, "--technique", "compute"}).at("technique"), "compute");
    const Json bench =
        answer({"bench", "--scene", file, "--technique", "compute", "--frames", "2", "--keep"});
    EXPECT_EQ(bench.at("technique"), "compute");
    EXPECT_EQ(bench.at("world_inputs"), 7);
    EXPECT_TRUE(bench.at("timings_ms").at("passes").contains("first hits")) << bench;
}

TEST_F(WorldTechniques, OtherQueriesRefuseTheDeviceByName) {
    const std::string poses = R"("shape": "square", "poses": [[0, 0, 0]])";
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({"query": "poses", "answer": "clearance", )" + poses,
         "compute does not answer poses with \"answer\": \"clearance\""},
        {R"({"query": "nearest", "points": [], "count": 2)",
         "compute does not answer nearest with a \"count\" above 1"},
        {R"({"query": "nearest", )" + poses, "compute does not answer nearest of a shape"},
        {R"({"query": "rays", "segments": [], "hits": "all")",
         "compute does not answer rays with \"hits\": \"all\""},
        {R"({"query": "cast", "shape": "square", "sweeps": [], "tolerance": 1)",
         "compute does not answer cast; of all instances it answers poses"},
        {R"({"query": "overlap", "points": [])", "compute does not answer overlap"},
    };
    std::string queries;
    for (const auto& [query, part] : cases) {
        queries += query + R"(, "technique": "compute"}, )";
    }
    queries += R"({"query": "rays", "segments": [], "technique": "raster"},
                  {"query": "rays", "segments": [], "technique": "drawing"},
                  {"query": "overlap", "points": [[1, 1]]})";
    // None of them needs a device.
    const Outcome outcome = run_program({"scene", scene(queries), "--json", "-"}, without_driver());
    EXPECT_EQ(outcome.status, 2);
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), cases.size() + 3);
    const auto expect_refusal = [&](std::size_t i, const std::string& part) {
        EXPECT_EQ(results.at(i).at("status"), "invalid_query") << part;
        const std::string message = results.at(i).at("message");
        EXPECT_NE(message.find("queries[" + std::to_string(i) + "]"), std::string::npos) << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        expect_refusal(i, cases[i].second);
    }
    expect_refusal(cases.size(), "raster does not answer rays");
    expect_refusal(cases.size() + 1, ".technique: ");
    EXPECT_EQ(results.back().at("status"), "ok");
    expect_refused({"bench", "--scene", scene(cases.back().first + "}"), "--technique", "compute"},
                   {"queries[0]", cases.back().second});
}

TEST_F(WorldTechniques, WithoutADeviceComputeEndsTheProgram) {
    const std::string file = scene(answered_by_device(""));
    EXPECT_EQ(run_program({"scene", file, "--technique", "compute"}, without_driver()).status, 3);
    EXPECT_EQ(run_program({"scene", file, "--technique", "automatic"}, without_driver()).status, 0);
}

}  // namespace
}  // namespace nearfield::test
