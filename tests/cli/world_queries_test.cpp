#include "strip_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using WorldQueries = StripScene;

/// A vector, compared to rounding.
void expect_point(const Json& json, double x, double y) {
    ASSERT_EQ(json.size(), 2U) << json;
    EXPECT_NEAR(json.at(0).get<double>(), x, 1e-12) << json;
    EXPECT_NEAR(json.at(1).get<double>(), y, 1e-12) << json;
}

TEST_F(WorldQueries, TheSceneOfTheDocumentsIsAnswered) {
    const Json json = answer({"scene", strip_file()});
    ASSERT_TRUE(json.is_object());
    EXPECT_TRUE(json.at("device").is_null());
    EXPECT_EQ(json.at("technique"), "cpu");
    EXPECT_EQ(json.at("results").size(), 13U);
    for (const Json& result : json.at("results")) {
        EXPECT_EQ(result.at("status"), "ok");
    }
}

TEST_F(WorldQueries, PosesHitOrNot) {
    const std::string poses = R"("poses": [[2.5, 1, 0], [4.5, 1, 0], [8, 3.5, 0], [2.5, 1, 45]])";
    const Json result =
        results_of(R"({"query": "poses", "shape": "square", "against": "placed", )" + poses + "}")
            .at(0);
    EXPECT_EQ(result.at("query"), "poses");
    EXPECT_EQ(result.at("technique"), "cpu");
    EXPECT_EQ(result.at("shape"), "square");
    EXPECT_EQ(result.at("against"), "placed");
    EXPECT_EQ(result.at("count"), 4);
    // Turned by 45 degrees, the square reaches 0.707 to the left of its corner.
    EXPECT_EQ(result.at("records"), Json({false, true, true, true}));
    EXPECT_EQ(result.at("hit_count"), 3);
    const Json all = results_of(R"({"query": "poses", "shape": "square", )" + poses + "}").at(0);
    EXPECT_TRUE(all.at("against").is_null());
    EXPECT_EQ(all.at("records"), Json({true, true, true, true})) << "i2 touches the first";
}

TEST_F(WorldQueries, PosesHaveClearances) {
    const std::string begin =
        R"({"query": "poses", "shape": "square", "answer": "clearance", "against": "placed",
            "poses": [[2.5, 2, 0], [7, 1, 0], [6, 3.25, 0]], )";
    const Json result = results_of(begin + R"("max_clearance": 0.75})").at(0);
    const Json& records = result.at("records");
    ASSERT_EQ(records.size(), 3U);
    EXPECT_EQ(records.at(0).at("instance"), "i1");
    EXPECT_DOUBLE_EQ(records.at(0).at("distance").get<double>(), 0.5);
    expect_point(records.at(0).at("point"), 2.5, 2);
    expect_point(records.at(0).at("nearest"), 2, 2);
    expect_point(records.at(0).at("direction"), -1, 0);
    EXPECT_EQ(records.at(1).at("distance"), 0.75);
    for (const char* const key : {"instance", "point", "nearest", "direction"}) {
        EXPECT_TRUE(records.at(1).at(key).is_null()) << key;
    }
    EXPECT_EQ(records.at(2).at("instance"), "bin");
    EXPECT_NEAR(records.at(2).at("distance").get<double>(), -0.25, 1e-12);
    expect_point(records.at(2).at("direction"), 0, -1);
    EXPECT_EQ(result.at("least").at("pose"), 2);
    EXPECT_EQ(result.at("least").at("distance"), records.at(2).at("distance"));

    // Below a limit the instance is not told, and the least clearance is the limit.
    const Json limited = results_of(begin + R"("min_clearance": 0.6})").at(0);
    EXPECT_EQ(limited.at("records").at(0).at("distance"), 0.6);
    EXPECT_TRUE(limited.at("records").at(0).at("instance").is_null());
    EXPECT_EQ(limited.at("least").at("pose"), 0);
    EXPECT_TRUE(limited.at("least").at("instance").is_null());
    const Json none = results_of(begin + R"("except": "bin", "max_clearance": 0})").at(0);
    EXPECT_TRUE(none.at("least").is_null());
}

TEST_F(WorldQueries, NearestInstancesAndEdges) {
    const Json result = results_of(R"({"query": "nearest", "points": [[2.5, 2.5], [4.5, 1.75]],
                                       "count": 9, "max_distance": 2.25, "against": "items"})")
                            .at(0);
    const Json& records = result.at("records");
    ASSERT_EQ(records.size(), 2U);
    ASSERT_EQ(records.at(0).size(), 3U);
    EXPECT_EQ(records.at(0).at(0).at("instance"), "i2");
    EXPECT_EQ(records.at(0).at(0).at("distance"), 0.0);
    EXPECT_EQ(records.at(0).at(0).at("feature"), Json({{"vertex", 2}}));
    EXPECT_EQ(records.at(0).at(1).at("instance"), "i1");
    EXPECT_NEAR(records.at(0).at(1).at("distance").get<double>(), std::sqrt(0.5), 1e-12);
    EXPECT_EQ(records.at(0).at(2).at("instance"), "i3");
    ASSERT_EQ(records.at(1).size(), 2U);
    EXPECT_EQ(records.at(1).at(0).at("instance"), "i3");
    EXPECT_DOUBLE_EQ(records.at(1).at(0).at("distance").get<double>(), -0.25) << "inside";
    EXPECT_EQ(records.at(1).at(0).at("feature"), Json({{"edge", 2}}));
    EXPECT_EQ(result.at("found"), 5);
    EXPECT_EQ(result.at("hit_count"), 2);

    const Json edges = records_of(
        R"({"query": "nearest", "points": [[4.25, 2.5], [7, 3.25], [7, 2]], "kind": "edges",
            "count": 1000000000, "max_distance": 0.95})");
    ASSERT_EQ(edges.at(0).size(), 3U) << edges;  // i3's top, its left side and its right side
    const double distances[] = {0.5, std::hypot(0.25, 0.5), std::hypot(0.75, 0.5)};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(edges.at(0).at(i).at("instance"), "i3");
        EXPECT_NEAR(edges.at(0).at(i).at("distance").get<double>(), distances[i], 1e-12);
    }
    ASSERT_EQ(edges.at(1).size(), 1U) << edges;
    EXPECT_EQ(edges.at(1).at(0).at("instance"), "bin");
    EXPECT_EQ(edges.at(1).at(0).at("feature"), Json({{"edge", 6}})) << "of the second ring";
    EXPECT_TRUE(edges.at(2).empty());
}

TEST_F(WorldQueries, RaysHitFirstOrAll) {
    const std::string segments = R"("segments": [[0.5, 1.25, 5.5, 1.25], [5.5, 3, 6.5, 3]])";
    const Json first = results_of(R"({"query": "rays", "except": "bin", )" + segments + "}").at(0);
    EXPECT_EQ(first.at("hit_count"), 1);
    const Json& hit = first.at("records").at(0);
    EXPECT_EQ(hit.at("instance"), "i1");
    EXPECT_DOUBLE_EQ(hit.at("parameter").get<double>(), 0.1);
    expect_point(hit.at("point"), 1, 1.25);
    expect_point(hit.at("normal"), -1, 0);
    EXPECT_EQ(hit.at("edge"), 3);
    EXPECT_TRUE(first.at("records").at(1).is_null());
    const Json all = records_of(R"({"query": "rays", "hits": "all", )" + segments + "}");
    std::string names;
    for (const Json& one : all.at(0)) {
        names += one.at("instance").get<std::string>() + " ";
    }
    EXPECT_EQ(names, "i1 i1 i3 i3 ");
    EXPECT_TRUE(all.at(1).empty());
}

TEST_F(WorldQueries, CastsStopAtTheFirstContact) {
    const std::string begin = R"({"query": "cast", "shape": "square", "against": "placed",
                                  "tolerance": 0.001,
                                  "sweeps": [[[6, 1, 0], [2, 1, 0]], [[6, 2.25, 0], [2, 2.25, 0]]])";
    const Json result = results_of(begin + "}").at(0);
    const Json& records = result.at("records");
    EXPECT_EQ(records.at(0).at("state"), "hit");
    EXPECT_EQ(records.at(0).at("instance"), "i3");
    EXPECT_LE(records.at(0).at("time").get<double>(), 0.25);
    EXPECT_NEAR(records.at(0).at("time").get<double>(), 0.25, 0.001);
    EXPECT_NEAR(records.at(0).at("nearest").at(0).get<double>(), 5.0, 1e-9);
    EXPECT_EQ(records.at(1).at("state"), "separated");
    EXPECT_EQ(records.at(1).at("time"), 1.0);
    EXPECT_TRUE(records.at(1).at("instance").is_null());
    EXPECT_TRUE(records.at(1).at("point").is_null());
    EXPECT_EQ(result.at("hit_count"), 1);
    // The second square passes 0.25 above i3.
    const Json wide = records_of(begin + R"(, "contact_distance": 0.6})");
    EXPECT_EQ(wide.at(1).at("state"), "hit");
    EXPECT_LT(wide.at(0).at("time").get<double>(), 0.11);
}

TEST_F(WorldQueries, OverlapsOfRectanglesPointsAndShapes) {
    const Json results = results_of(
        R"({"query": "overlap", "rectangles": [[0.5, 0.5, 2, 2], [6, 1, 7, 2], [1, 1, 1, 1]]},
           {"query": "overlap", "points": [[1.75, 1.75], [10.25, 1.5], [7, 3]]},
           {"query": "overlap", "shape": "square", "poses": [[3.5, 0.5, 45], [4.5, 3.5, 0]]},
           {"query": "overlap", "rectangles": [], "against": "i1"})");
    EXPECT_EQ(results.at(0).at("records"), Json::parse(R"([["i1", "i2"], [], ["i1"]])"));
    EXPECT_EQ(results.at(0).at("hit_count"), 2);
    EXPECT_EQ(results.at(0).at("found"), 3);
    EXPECT_EQ(results.at(1).at("records"), Json::parse(R"([["i1", "i2"], ["bin", "i4"], []])"));
    EXPECT_EQ(results.at(2).at("records"), Json::parse(R"([["i3"], ["bin"]])"));
    EXPECT_EQ(results.at(3).at("records"), Json::array());
    EXPECT_EQ(results.at(3).at("count"), 0);
}

TEST_F(WorldQueries, AnswersDoNotDependOnThreads) {
    Json strip = StripScene::strip();
    for (int i = 0; i < 2000; ++i) {
        strip["queries"][2]["poses"].push_back({0.005 * i, 0.002 * i, i});
    }
    const std::string file = folder_.write("many.json", strip.dump());
    const Json alone = answer({"scene", file});
    const Json together = answer({"scene", file, "--threads", "3"});
    ASSERT_TRUE(alone.is_object());
    EXPECT_EQ(alone.at("results"), together.at("results"));
}

TEST_F(WorldQueries, BadInputIsNamedByItsPlace) {
    const std::string poses = R"({"query": "poses", "shape": "square", )";
    const std::string cast = R"({"query": "cast", "shape": "square", )";
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({"query": "poses", "poses": []})", ": has no \"shape\""},
        {R"({"query": "poses", "shape": "disc", "poses": []})", ".shape: there is no shape"},
        {poses + R"("against": "all", "poses": []})", ".against: there is no group or instance"},
        {poses + R"("except": "items", "poses": []})", ".except: there is no instance \"items\""},
        {poses + R"("records": 1, "poses": []})", ".records: neither true nor false"},
        {poses + R"("values": "v.txt", "poses": []})", ".values: \"v.txt\" ends neither in .npy"},
        {poses + R"("values": "v.csv", "records": false, "poses": []})", ".values: there are no"},
        {poses + R"("answer": "yes", "poses": []})", ".answer: \"yes\" is none of hits, clearance"},
        {poses + R"("min_clearance": 0, "poses": []})", ".min_clearance: belongs to the answer"},
        {poses + R"("answer": "clearance", "max_clearance": -1, "poses": []})",
         ".max_clearance: expected a number of at least 0"},
        {poses + R"("answer": "clearance", "min_clearance": 2, "max_clearance": 2, "poses": []})",
         ".min_clearance: expected less than"},
        {poses.substr(0, poses.size() - 2) + "}", ": needs either \"poses\" or \"poses_file\""},
        {poses + R"("poses": [], "poses_file": "x.csv"})", ": needs either \"poses\" or"},
        {poses + R"("poses_file": "none.csv"})", "none.csv: cannot be opened"},
        {poses + R"("poses": 7})", ".poses: not an array but a number"},
        {poses + R"("poses": [[0, 0, 0], [1, 2]]})", ".poses[1]: expected [x, y, degrees]"},
        {poses + R"("poses": [[0, 0, "0"]]})", ".poses[0][2]: not a number but a string"},
        {poses + R"("poses": [[0, 0, 0], [0, 0, 9e9]]})", ".poses[1]: an angle of 9e+09 degrees"},
        {poses + R"("poses": [[0, 2e12, 0]]})", ".poses[0]: y is 2000000000000; coordinates must"},
        {R"({"query": "nearest", "points": [[0, 0], [-2e12, 0]]})", ".points[1]: x is -2000000"},
        {R"({"query": "nearest", "points": [[0]]})", ".points[0]: expected [x, y]"},
        {R"({"query": "nearest", "points": [], "count": 0})", ".count: expected a whole number"},
        {R"({"query": "nearest", "points": [], "kind": "corners"})", "none of instances, edges"},
        {R"({"query": "nearest", "points": [], "max_distance": -1})", ".max_distance: expected"},
        {R"({"query": "rays", "segments": [[0, 0, 1]]})",
         ".segments[0]: expected [x0, y0, x1, y1]"},
        {R"({"query": "rays", "segments": [[0, 0, 1, 2e12]]})", ".segments[0]: y is 2000000"},
        {R"({"query": "rays", "segments": [], "hits": "some"})",
         ".hits: \"some\" is none of first"},
        {cast + R"("sweeps": []})", ": has no \"tolerance\""},
        {cast + R"("sweeps": [], "tolerance": 0})", ".tolerance: expected a number greater than 0"},
        {cast + R"("sweeps": [], "tolerance": 1e99})",
         ": invalid_query: cast_shape: the tolerance"},
        {cast + R"("sweeps": [[[0, 0, 0]]], "tolerance": 1})", ".sweeps[0]: expected [[x, y, "},
        {cast + R"("sweeps": [[[0, 0, 0], [0, 0]]], "tolerance": 1})", ".sweeps[0][1]: expected"},
        {cast + R"("sweeps": [[[0, 0, 0], [0, 0, 9e9]]], "tolerance": 1})", ".sweeps[0]: an angle"},
        {cast + R"("sweeps": [], "tolerance": 1, "contact_distance": -1})", ".contact_distance: "},
        {R"({"query": "overlap"})", ": needs either \"rectangles\", \"points\", or"},
        {R"({"query": "overlap", "points": [], "rectangles": []})",
         ": needs either \"rectangles\""},
        {R"({"query": "overlap", "points": [], "shape": "square"})",
         ".shape: belongs to \"poses\""},
        {R"({"query": "overlap", "poses": []})", ": has no \"shape\""},
        {R"({"query": "overlap", "rectangles": [[1, 0, 0, 1]]})", ".rectangles[0]: expected x0 <="},
        {R"({"query": "near", "points": []})", "contacts, closest-point, separation"},
        {R"({"query": "near", "points": []})", "poses, nearest, rays, cast, overlap"},
    };
    std::string queries;
    for (const auto& [query, part] : cases) {
        queries += query + ", ";
    }
    const Outcome outcome = run_program(
        {"scene", scene(queries + R"({"query": "overlap", "points": [[1, 1]]})"), "--json", "-"});
    EXPECT_EQ(outcome.status, 2);
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), cases.size() + 1);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_EQ(results.at(i).at("status"), "invalid_query") << cases[i].first;
        const std::size_t place = outcome.err.find("queries[" + std::to_string(i) + "]");
        ASSERT_NE(place, std::string::npos) << cases[i].first << '\n' << outcome.err;
        const std::string line = outcome.err.substr(place, outcome.err.find('\n', place) - place);
        EXPECT_NE(line.find(cases[i].second), std::string::npos) << line;
    }
    EXPECT_EQ(results.back().at("status"), "ok");
    expect_refused({"scene", scene(R"({"query": "rays", "segments": [], "tolerance": 1})")},
                   {"queries[0].tolerance", "is not known here"});
}

TEST_F(WorldQueries, BadInstancesAreNamedAndTheOthersAnswered) {
    Json scene = strip();
    scene["shapes"]["gone"] = {{"file", "gone.wkt"}};
    scene["instances"]["i5"] = {{"shape", "gone"}};
    scene["queries"] = Json::parse(R"([
        {"query": "nearest", "points": [[4.5, 2.5]]},
        {"query": "nearest", "points": [[4.5, 2.5]], "against": "items"},
        {"query": "nearest", "points": [[4.5, 2.5]], "except": "i5"},
        {"query": "poses", "shape": "gone", "poses": [[0, 0, 0]], "against": "items"}])");
    const Outcome outcome =
        run_program({"scene", folder_.write("scene.json", scene.dump()), "--json", "-"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("gone.wkt: cannot be opened"), std::string::npos) << outcome.err;
    const Json results = Json::parse(outcome.out).at("results");
    ASSERT_EQ(results.size(), 5U);
    EXPECT_EQ(results.at(0).at("records").at(0).at(0).at("instance"), "i3");
    EXPECT_EQ(results.at(1).at("status"), "invalid_query");
    EXPECT_NE(results.at(1).at("message").get<std::string>().find("i5 (shapes.gone)"),
              std::string::npos)
        << results.at(1);
    EXPECT_EQ(results.at(2).at("status"), "ok");
    EXPECT_EQ(results.at(3).at("status"), "ok");
    EXPECT_EQ(results.at(4).at("status"), "invalid_query");
    EXPECT_NE(results.at(4).at("message").get<std::string>().find("shapes.gone"),
              std::string::npos);
}

TEST_F(WorldQueries, CurvesAreTessellatedForCastsOrAsStated) {
    folder_.write("disc.path", "M 1 0 A 1 1 0 1 1 -1 0 A 1 1 0 1 1 1 0 Z");
    Json scene = strip();
    scene["shapes"]["disc"] = {{"file", "disc.path"}};
    const Json overlap = Json::parse(
        R"({"query": "overlap", "shape": "disc", "poses": [[7, 3.05, 0], [7, 2.95, 0]]})");
    scene["queries"] = Json::array({overlap});
    const std::string file = folder_.path("scene.json");
    folder_.write("scene.json", scene.dump());
    const Outcome unknown = run_program({"scene", file});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("shapes.disc: has curves"), std::string::npos) << unknown.err;
    scene["shapes"]["disc"]["deviation"] = 0.001;
    folder_.write("scene.json", scene.dump());
    EXPECT_EQ(answer({"scene", file}).at("results").at(0).at("records"),
              Json::parse(R"([["bin"], []])"));
    scene["shapes"]["disc"].erase("deviation");
    scene["queries"].push_back(Json::parse(R"({"query": "cast", "shape": "disc",
        "sweeps": [[[7, 2, 0], [7, 4, 0]]], "tolerance": 0.01})"));
    folder_.write("scene.json", scene.dump());
    const Json hit = answer({"scene", file}).at("results").at(1).at("records").at(0);
    EXPECT_EQ(hit.at("instance"), "bin");
    EXPECT_NEAR(hit.at("time").get<double>(), 0.5, 0.01);
}

}  // namespace
}  // namespace nearfield::test
