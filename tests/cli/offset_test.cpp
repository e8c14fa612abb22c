#include "cli_test.hpp"

#include <cmath>
#include <string>

namespace nearfield::test {
namespace {

/// Outlines that grow or shrink before they are asked about.
class Offsets : public CliTest {};

TEST_F(Offsets, MoveTheBoundariesOfBothWithinTheBound) {
    const Arguments ask{"query", "separation", a_, b_, "--pose-b", "9,0,0", "--deviation", "1e-4"};
    for (const double offset : {0.5, 2.0, -0.25}) {
        const Json json = answer(ask + Arguments{"--offset", std::to_string(offset)});
        ASSERT_TRUE(json.is_object());
        const double bound = json.at("error_bound").get<double>();
        EXPECT_NEAR(json.at("distance").get<double>(), 8.0 - 2.0 * offset, bound);
        EXPECT_GT(bound, 0.0);
        EXPECT_LE(bound, 2.01e-4);
    }
}

TEST_F(Offsets, FollowFillRulesAndCurves) {
    const std::string circle = folder_.write("circle.svg", "<svg><circle r='1'/></svg>");
    EXPECT_NEAR(distance_at(circle, "2,0", {"--offset", "0.5"}), 0.5, 0.03);
    const std::string overlapping =
        folder_.write("overlapping.wkt", "MULTIPOLYGON(((0 0,2 0,2 2,0 2)),((1 1,3 1,3 3,1 3)))");
    // The region of the odd-even rule has a hole there, which closes only by more than a half.
    EXPECT_NEAR(distance_at(overlapping, "1.5,1.5", {"--offset", "0.25"}), 0.25, 0.03);
    // Their union's inner corners stay sharp, and move by the offset in x and in y.
    EXPECT_NEAR(distance_at(overlapping, "1.5,1.5", {"--offset", "0.25", "--fill-rule", "nonzero"}),
                -std::hypot(0.75, 0.75), 0.03);
}

TEST_F(Offsets, OfScenesAndLayouts) {
    const std::string file = folder_.write("scene.json", R"({
        "shapes": {"grown": {"file": "b.wkt", "offset": 0.5, "deviation": 0.001},
                   "shrunk": {"rings": [[[0, 0], [1, 0], [1, 1], [0, 1]]], "offset": -0.125}},
        "instances": {"G": {"shape": "grown"}, "S": {"shape": "shrunk", "pose": [3, 0, 0]}},
        "queries": [{"query": "separation", "a": "G", "b": "S", "tolerance": 0.01}]})");
    folder_.write("b.wkt", "POLYGON((0 0,1 0,1 1,0 1))");
    const Json scene = answer({"scene", file});
    ASSERT_TRUE(scene.is_object());
    EXPECT_NEAR(scene.at("results").at(0).at("distance").get<double>(), 1.625, 0.002);

    const std::string layout =
        folder_.write("layout.svg",
                      "<svg><rect id='a' width='2' height='2'/><rect id='b' x='3' width='2' "
                      "height='2'/></svg>");
    const auto meet = [&](const std::string& offset) {
        const Json json =
            answer({"scene", layout, "--query", "intersection-test", "--offset", offset});
        return json.at("results").at(0).at("intersects").get<bool>();
    };
    EXPECT_TRUE(meet("0.5002"));
    const Json none = answer(
        {"scene", layout, "--query", "intersection-test", "--hits-only", "--offset", "0.4998"});
    EXPECT_TRUE(none.at("results").empty());
}

TEST_F(Offsets, RefusalsSayWhatIsWrong) {
    const Arguments ask{"query", "separation", a_, b_, "--pose-b", "9,0,0"};
    expect_refused(ask + Arguments{"--offset", "0"},
                   {"--offset", "expected a finite number other than 0"});
    expect_refused(ask + Arguments{"--offset", "wide"}, {"--offset", "wide"});
    expect_refused(ask + Arguments{"--offset", "1"},
                   {"--deviation: required for curves and offsets"});
    expect_refused(ask + Arguments{"--offset", "-0.51", "-d", "0.01"},
                   {"nothing is left of it by an offset of -0.51"});
    expect_refused(ask + Arguments{"--offset", "1", "--deviation", "1e-14"},
                   {"deviation", "below"});
    expect_refused(ask + Arguments{"--offset", "1e9", "-d", "0.01"},
                   {"the offset needs more than 1048576 vertices"});
    const std::string file = folder_.write("scene.json", R"({"shapes": {}, "instances": {},
                                                             "queries": []})");
    expect_refused({"scene", file, "--offset", "1"}, {"--offset: belongs to outlines"});
    const Outcome wrong = run_program({"scene", folder_.write("wrong.json", R"({
        "shapes": {"s": {"rings": [[[0, 0], [1, 0], [1, 1]]], "offset": 0},
                   "t": {"rings": [[[0, 0], [1, 0], [1, 1]]], "offset": 1}}, "instances": {},
        "queries": []})")});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("shapes.s.offset: expected a number other than 0"), std::string::npos)
        << wrong.err;
    EXPECT_NE(wrong.err.find("shapes.t: has curves or an offset"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace nearfield::test
