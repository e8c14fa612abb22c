#include "cli_test.hpp"

#include <string>

namespace nearfield::test {
namespace {

/// Outlines that are not clean odd-even ones.
class FillRules : public CliTest {
protected:
    // Two squares that overlap, and a frame with a hole.
    const std::string overlapping_ =
        folder_.write("overlapping.wkt", "MULTIPOLYGON(((0 0,4 0,4 4,0 4)),((2 2,6 2,6 6,2 6)))");
    const std::string frames_ = folder_.write(
        "frames.wkt", "MULTIPOLYGON(((0 0,4 0,4 4,0 4),(1 1,3 1,3 3,1 3)),((2 2,6 2,6 6,2 6)))");
    const std::string sliver_ =
        folder_.write("sliver.wkt", "MULTIPOLYGON(((0 0,4 0,4 4,0 4)),((5 5,6 6,7 7)))");
};

TEST_F(FillRules, DecideWhatIsInside) {
    // The union's inner corners, (4, 2) and (2, 4), are nearest; the odd-even boundary passes (2,
    // 2).
    EXPECT_NEAR(distance_at(overlapping_, "2.5,2.5", {}), 0.5, 0.05);
    for (const char* const rule : {"nonzero", "positive", "union"}) {
        EXPECT_NEAR(distance_at(overlapping_, "2.5,2.5", {"--fill-rule", rule}), -1.58, 0.05)
            << rule;
    }
    EXPECT_NEAR(distance_at(overlapping_, "2.5,2.5", {"--fill-rule", "odd-even"}), 0.5, 0.05);
}

TEST_F(FillRules, UnionKeepsTheHolesOfParts) {
    const Arguments united{"--fill-rule", "union"};
    EXPECT_NEAR(distance_at(frames_, "1.5,1.5", united), 0.5, 0.05);
    EXPECT_NEAR(distance_at(frames_, "2.5,2.5", united), -0.5, 0.05);
    const std::string json = folder_.write("frames.geojson", R"({"type": "MultiPolygon",
        "coordinates": [[[[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [3, 1], [3, 3], [1, 3]]],
                        [[[2, 2], [6, 2], [6, 6], [2, 6]]]]})");
    EXPECT_NEAR(distance_at(json, "1.5,1.5", united), 0.5, 0.05);
    EXPECT_NEAR(distance_at(json, "2.5,2.5", united), -0.5, 0.05);
}

TEST_F(FillRules, RingsThatEncloseNothingAreDroppedAndListed) {
    const Outcome outcome =
        run_program({"query", "separation", a_, sliver_, "--pose-a", "9,0,0", "--json", "-"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("sliver.wkt: dropped 1 of 2 rings that enclose nothing: ring 1 from "
                               "(5, 5), 0 wide"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out).at("distance"), 5.0);
    const Arguments ask{"query", "separation", a_, sliver_, "--pose-a", "9,0,0"};
    expect_refused(ask + Arguments{"--strict"}, {"sliver.wkt", "ring 1", "line"});
    expect_refused(ask + Arguments{"--strict", "--fill-rule", "nonzero"},
                   {"sliver.wkt: 1 of 2 rings encloses nothing: ring 1 from (5, 5)"});
    expect_refused(ask + Arguments{"--strict", "--clean-width", "0.1"}, {"--strict"});
}

TEST_F(FillRules, CleaningDropsWhatIsThin) {
    const std::string file = folder_.write(
        "thin.wkt", "MULTIPOLYGON(((0 0,2 0,4 0,4 4,0 4)),((5 0,6 0,6 0.01,5 0.01)))");
    const Arguments ask{"query", "separation", a_, file, "--pose-a", "9,0,0", "--json", "-"};
    const Outcome kept = run_program(ask);
    EXPECT_EQ(kept.err.find("dropped"), std::string::npos) << kept.err;
    EXPECT_EQ(Json::parse(kept.out).at("distance"), 3.0);
    const Outcome dropped = run_program(ask + Arguments{"--clean-width", "0.02"});
    EXPECT_EQ(dropped.status, 0) << dropped.err;
    EXPECT_NE(dropped.err.find("dropped 1 of 2 rings no wider than 0.02"), std::string::npos)
        << dropped.err;
    EXPECT_NE(dropped.err.find("dropped 1 vertices: 0 repeated, 1 on straight lines"),
              std::string::npos)
        << dropped.err;
    const Json json = Json::parse(dropped.out);
    EXPECT_EQ(json.at("distance"), 5.0);
    EXPECT_GE(json.at("error_bound"), 0.005);
    const std::string only = folder_.write("only.wkt", "POLYGON((5 0,6 0,6 0.01,5 0.01))");
    expect_refused({"query", "separation", a_, only, "--clean-width", "0.02"},
                   {"only.wkt: all of it is no wider than 0.02"});
}

TEST_F(FillRules, RefusalsNameTheRule) {
    expect_refused({"query", "separation", a_, b_, "--fill-rule", "evenodd"},
                   {"--fill-rule", "\"evenodd\" is none of odd-even, nonzero, positive, union"});
    const std::string clockwise = folder_.write("clockwise.wkt", "POLYGON((0 0,0 1,1 1,1 0))");
    expect_refused({"query", "separation", a_, clockwise, "--fill-rule", "positive"},
                   {"clockwise.wkt: nothing is left of it by the fill rule positive"});
}

TEST_F(FillRules, ShapesOfScenesHaveTheirOwn) {
    const std::string file = folder_.write("scene.json", R"({
        "shapes": {"united": {"file": "frames.wkt", "fill_rule": "union"},
                   "sliver": {"file": "sliver.wkt"},
                   "rings": {"rings": [[[0, 0], [4, 0], [4, 4], [0, 4]],
                                       [[2, 2], [6, 2], [6, 6], [2, 6]],
                                       [[7, 7], [8, 8], [9, 9]]],
                             "fill_rule": "nonzero", "clean_width": 0.001},
                   "dot": {"rings": [[[0, 0], [0.1, 0], [0.1, 0.1]]]}},
        "instances": {"U": {"shape": "united"}, "R": {"shape": "rings"}, "S": {"shape": "sliver"},
                      "dot": {"shape": "dot", "pose": [2.5, 2.5, 0]}},
        "queries": [{"query": "separation-vector", "a": "dot", "b": "R", "tolerance": 0.01},
                    {"query": "separation-vector", "a": "dot", "b": "U", "tolerance": 0.01},
                    {"query": "intersection-test", "a": "dot", "b": "S"}]})");
    const Outcome outcome = run_program({"scene", file, "--json", "-"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("scene.json: shapes.sliver: "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("ring 1 from (5, 5)"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("scene.json: shapes.rings.rings: dropped 1 of 3 rings"),
              std::string::npos)
        << outcome.err;
    const Json results = Json::parse(outcome.out).at("results");
    // Out of the union; by the odd-even rule the dot would be outside.
    EXPECT_NEAR(results[0].at("length").get<double>(), 1.6, 0.1);
    EXPECT_LT(results[1].at("length").get<double>(), 1.0);
    EXPECT_EQ(results[2].at("intersects"), true);

    const Outcome strict = run_program({"scene", file, "--strict", "--json", "-"});
    EXPECT_EQ(strict.status, 2);
    EXPECT_NE(strict.err.find("scene.json: shapes.sliver"), std::string::npos) << strict.err;
    const Outcome wrong = run_program({"scene", folder_.write("wrong.json", R"({
        "shapes": {"s": {"file": "frames.wkt", "fill_rule": "odd"}}, "instances": {},
        "queries": []})")});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("shapes.s.fill_rule: \"odd\" is none of odd-even"), std::string::npos)
        << wrong.err;
}

}  // namespace
}  // namespace nearfield::test
