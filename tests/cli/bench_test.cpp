#include "cli_test.hpp"
#include "contract.hpp"

#include <cstddef>

namespace nearfield::test {
namespace {

/// A scene whose first shape is in a separate file.
constexpr auto good_scene = R"({
"shapes": {"disk": {"file": "a square.geojson"},
           "house": {"rings": [[[0, 0], [1, 0], [1, 1], [0.5, 1.5], [0, 1]]]}},
"instances": {"A": {"shape": "disk"},
              "B": {"shape": "house", "pose": [0.6, 0.3, 15]},
              "far": {"shape": "house", "pose": [100, 0, 0]}},
"queries": [{"query": "penetration", "a": "A", "b": "B", "tolerance": 0.05},
            {"query": "penetration", "a": "B", "b": "far", "tolerance": 0.05, "records": false},
            {"query": "intersection", "a": "B", "b": "A", "tolerance": 0.05,
             "kind": "boundary-volume", "technique": "raster", "strategy": "logic-op"},
            {"query": "distance-field", "a": "A", "b": "B", "tolerance": 0.1,
             "rect": [-1, -1, 2, 2]}]
})";

/// A small row: two bars of 100 vertices.
constexpr auto small_row = "wavy x1, vertices";

class Bench : public CliTest {
protected:
    /// The good scene with part of its text replaced.
    std::string scene_with(const std::string& piece, const std::string& other) const {
        std::string text = good_scene;
        const std::size_t place = text.find(piece);
        EXPECT_NE(place, std::string::npos) << piece;
        return folder_.write("scene.json", text.replace(place, piece.size(), other));
    }

    void expect_bad_scene(const std::string& piece, const std::string& other,
                          std::vector<std::string> parts) const {
        const std::string scene = scene_with(piece, other);
        parts.push_back(scene);
        expect_refused(
            {"bench", "--scene", scene, "--frames", "1", "--json", folder_.path("bench.json")},
            parts);
    }
};

TEST_F(Bench, TellsMedianFramesDeviceAndTimesByPass) {
    const std::string scene = folder_.write("scene.json", good_scene);
    const Json json = answer({"bench", "--scene", scene, "--frames", "4", "--warmup", "1"});
    ASSERT_TRUE(json.is_object());
    expect_number(json, "median_ms");
    EXPECT_GT(json.at("median_ms").get<double>(), 0.0);
    EXPECT_EQ(json.at("frames"), 4);
    EXPECT_TRUE(json.at("device").is_string());
    const Json& passes = json.at("timings_ms").at("passes");
    ASSERT_TRUE(passes.is_object());
    EXPECT_FALSE(passes.empty());
    double sum = 0.0;
    for (const auto& [name, time] : passes.items()) {
        EXPECT_GE(time.get<double>(), 0.0) << name;
        sum += time.get<double>();
    }
    EXPECT_GT(sum, 0.0);
}

TEST_F(Bench, TellsHowManyPairsItAskedAbout) {
    const std::string queries = good_scene;
    const Arguments good{"bench", "--scene", folder_.write("scene.json", queries), "--frames", "1"};
    const Json json = answer(good);
    EXPECT_EQ(json.at("pairs"), 4);
    EXPECT_EQ(json.at("world_inputs"), 0);
    EXPECT_EQ(json.at("keep"), false);
    EXPECT_NE(run_program(good).out.find("\npairs             4\n"), std::string::npos);
    // A and B meet, far meets neither: both orders of one pair.
    Json all = Json::parse(queries);
    all["queries"] = Json::parse(
        R"([{"query": "penetration", "pairs": "all", "tolerance": 0.05, "hits_only": true},
            {"query": "nearest", "points": [[0, 0], [1, 1], [2, 2]]},
            {"query": "overlap", "points": [[0, 0]]}])");
    const Arguments pairs{"bench", "--scene", folder_.write("all.json", all.dump()), "--frames",
                          "2"};
    for (const Json& frames : {answer(pairs), answer(pairs + Arguments{"--keep"})}) {
        EXPECT_EQ(frames.at("pairs"), 2);
        EXPECT_EQ(frames.at("world_inputs"), 4);
    }
    EXPECT_EQ(answer(pairs + Arguments{"--keep"}).at("keep"), true);
    const Outcome kept = run_program(pairs + Arguments{"--keep"});
    EXPECT_NE(kept.out.find("2, shapes kept"), std::string::npos) << kept.out;
    EXPECT_NE(kept.out.find("\nworld inputs      4\n"), std::string::npos) << kept.out;
    expect_refused({"bench", "--keep", "--filter", small_row}, {"--keep", "--scene"});
}

TEST_F(Bench, PrintsASummaryAndWritesAFile) {
    const std::string scene = folder_.write("scene.json", good_scene);
    const Outcome outcome = run_program({"bench", "--scene", scene, "--frames", "2", "--technique",
                                         "raster", "--json", folder_.path("bench.json")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("median"), std::string::npos) << outcome.out;
    EXPECT_EQ(Json::parse(folder_.read("bench.json")).at("frames"), 2);
}

TEST_F(Bench, TheTechniqueOfTheCommandLineIsThatOfAllQueries) {
    std::string text = good_scene;
    text = text.substr(0, text.find("            {\"query\": \"intersection\"")) + "]}";
    text.erase(text.rfind(','), 1);
    const std::string scene = folder_.write("two.json", text);
    const Arguments bench{"bench", "--scene", scene, "--frames", "1"};
    EXPECT_EQ(answer(bench).at("technique"), "cpu");
    EXPECT_EQ(answer(bench + Arguments{"--technique", "raster"}).at("technique"), "raster");
    EXPECT_EQ(answer(bench + Arguments{"--technique", "compute"}).at("technique"), "compute");
    EXPECT_EQ(
        answer({"scene", scene, "--technique", "compute"}).at("results").at(1).at("technique"),
        "compute");
    const Json answers = answer({"scene", scene, "--technique", "raster"});
    EXPECT_EQ(answers.at("technique"), "raster");
    EXPECT_EQ(answers.at("results").at(1).at("technique"), "raster");
    EXPECT_EQ(answer({"bench", "--scene", folder_.write("scene.json", good_scene), "--frames", "1"})
                  .at("technique"),
              "mixed");
}

TEST_F(Bench, RefusesScenesByFileAndPlace) {
    expect_bad_scene("]\n}", "\n}", {"scene.json:13:1: "});
    expect_bad_scene("\"shape\": \"house\"", "\"shape\": \"home\"", {"instances.B.shape", "home"});
    expect_bad_scene("\"b\": \"far\"", "\"b\": \"near\"", {"queries[1].b", "near"});
    expect_bad_scene("\"kind\"", "\"points\"", {"queries[2].points"});
    expect_bad_scene("[0.6, 0.3, 15]", "[0.6, 0.3]", {"instances.B.pose"});
    expect_bad_scene("[-1, -1, 2, 2]", "[-1, -1, 2, -2]", {"queries[3].rect"});
}

TEST_F(Bench, RefusesWhatOnlyTheLibraryFindsByFileAndPlace) {
    expect_bad_scene("[1, 1], [0.5, 1.5], [0, 1]", "[0, 0]", {"house", "ring 0", "three"});
    expect_bad_scene("\"b\": \"B\", \"tolerance\": 0.1,\n             \"rect\": [-1, -1, 2, 2]",
                     "\"b\": \"far\", \"tolerance\": 0.1", {"queries[3]", "nothing in common"});
    expect_bad_scene("\"tolerance\": 0.1", "\"tolerance\": 1e-9",
                     {"query 3", "the smallest tolerance that fits"});
}

TEST_F(Bench, WithoutASceneItMeasuresRowsOfTheStandardTableByEachTechnique) {
    const Json json = answer({"bench", "--filter", small_row});
    for (const auto& name : {"commit", "date", "processor", "device", "driver"}) {
        EXPECT_FALSE(json.at(name).get<std::string>().empty()) << name;
    }
    ASSERT_EQ(json.at("rows").size(), 1U);
    const Json& row = json.at("rows").at(0);
    EXPECT_EQ(row.at("name"), small_row);
    EXPECT_EQ(row.at("queries"), 2);
    EXPECT_EQ(row.at("vertices"), 200);
    EXPECT_GT(row.at("cells"), 0);
    EXPECT_GT(row.at("found"), 0);
    EXPECT_GT(row.at("automatic_to_best"), 0.0);
    for (const auto& name : {"raster", "cpu", "automatic"}) {
        const Json& technique = row.at("techniques").at(name);
        EXPECT_GE(technique.at("frames"), 2) << name;
        EXPECT_LE(technique.at("min_ms"), technique.at("quartiles_ms").at(0)) << name;
        EXPECT_LE(technique.at("quartiles_ms").at(0), technique.at("median_ms")) << name;
        EXPECT_LE(technique.at("median_ms"), technique.at("quartiles_ms").at(1)) << name;
        EXPECT_EQ(technique.at("found"), row.at("found")) << name;
        EXPECT_EQ(technique.at("gpu_ms").is_null(), technique.at("technique") == "cpu") << name;
    }
    EXPECT_TRUE(row.at("techniques").contains("compute"));
}

TEST_F(Bench, ATechniqueThatRefusesARowIsNamedInTheTable) {
    const Outcome outcome = run_program(
        {"bench", "--filter", "wavy at 4d, intersection", "--json", folder_.path("table.json")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json row = Json::parse(folder_.read("table.json")).at("rows").at(0);
    std::size_t refused = 0;
    for (const auto& [name, technique] : row.at("techniques").items()) {
        if (technique.contains("refused")) {
            ++refused;
            const std::string reason = technique.at("refused");
            EXPECT_NE(reason.find(name), std::string::npos) << reason;
            EXPECT_NE(outcome.out.find("] " + reason), std::string::npos) << outcome.out;
        }
    }
    EXPECT_EQ(outcome.out.find("refused") == std::string::npos, refused == 0) << outcome.out;
    EXPECT_NE(outcome.out.find("| wavy at 4d, intersection"), std::string::npos) << outcome.out;
}

TEST_F(Bench, MeasuresWhenAGpuIsWorthItsWhile) {
    const std::string file = folder_.path("gpu.json");
    const Outcome outcome =
        run_program({"bench", "--gpu", "--filter", "crowd of 420 objects", "--json", file});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\n| crowd of 420 objects | "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("* device pairs: "), std::string::npos) << outcome.out;
    const Json json = Json::parse(folder_.read("gpu.json"));
    EXPECT_FALSE(json.at("device").get<std::string>().empty());
    ASSERT_EQ(json.at("rows").size(), 1U);
    const Json& row = json.at("rows").at(0);
    // About 2.4 pairs an object, either way.
    EXPECT_GT(row.at("pairs"), 4 * 420);
    EXPECT_LT(row.at("pairs"), 6 * 420);
    EXPECT_GT(row.at("points"), row.at("pairs"));
    for (const auto& name : {"cpu", "raster", "compute", "device pairs", "device pairs, read",
                             "device pairs, resident"}) {
        const Json& time = row.at("times").at(name);
        EXPECT_GE(time.at("frames"), 3) << name;
        EXPECT_GT(time.at("median_ms"), 0.0) << name;
        EXPECT_GT(time.at("cpu_ms"), 0.0) << name;
        EXPECT_EQ(time.at("device_ms").is_null(), std::string(name) == "cpu") << name;
    }
}

TEST_F(Bench, SaysWhichRowsOfAGpuAreTooLarge) {
    const std::string file = folder_.path("gpu.json");
    const Outcome outcome = run_program({"bench", "--gpu", "--filter", "crowd of 420 objects",
                                         "--memory-limit", "1", "--json", file});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json times = Json::parse(folder_.read("gpu.json")).at("rows").at(0).at("times");
    const std::string reason = times.at("device pairs, resident").at("refused");
    EXPECT_NE(reason.find("memory_limit"), std::string::npos) << reason;
    EXPECT_NE(outcome.out.find("* crowd of 420 objects by device pairs, resident: " + reason),
              std::string::npos)
        << outcome.out;
}

TEST_F(Bench, MeasuresFieldsOnAGpu) {
    const Json json = answer({"bench", "--gpu", "--filter", "field 256"});
    ASSERT_EQ(json.at("rows").size(), 1U);
    EXPECT_EQ(json.at("rows").at(0).at("cells"), 256 * 256);
    EXPECT_GT(json.at("rows").at(0).at("times").at("compute").at("median_ms"), 0.0);
}

TEST_F(Bench, RefusesAFilterThatLeavesNoRowAndOptionsOfTheOtherWay) {
    expect_refused({"bench", "--filter", "no such row"}, {"--filter", "no such row", small_row});
    expect_refused({"bench", "--gpu", "--filter", "no such row"},
                   {"no such row", "crowd of 420 objects"});
    expect_refused({"bench", "--gpu", "--paper"}, {"--gpu", "--paper"});
    expect_refused({"bench", "--scene", folder_.write("scene.json", good_scene), "--gpu"},
                   {"--gpu", "--scene"});
    expect_refused({"bench", "--filter", small_row, "--frames", "3"}, {"--frames", "--scene"});
    expect_refused({"bench", "--filter", small_row, "--technique", "cpu"},
                   {"--technique", "--scene"});
    expect_refused({"bench", "--scene", folder_.write("scene.json", good_scene), "--filter", "x"},
                   {"--filter", "--scene"});
}

TEST_F(Bench, RefusesFilesThatAreNone) {
    expect_refused({"bench", "--scene", folder_.path("none.json")},
                   {folder_.path("none.json"), "cannot be opened"});
    expect_refused({"bench", "--scene", scene_with("a square.geojson", "missing.wkt")},
                   {folder_.path("missing.wkt"), "cannot be opened"});
    const std::string scene = folder_.write("scene.json", good_scene);
    const std::string nowhere = folder_.path("no such folder/bench.json");
    expect_refused({"bench", "--scene", scene, "--json", nowhere}, {nowhere, "cannot be written"});
}

}  // namespace
}  // namespace nearfield::test
