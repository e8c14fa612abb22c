#include "cli_test.hpp"

#include <set>
#include <string>
#include <utility>

namespace nearfield::test {
namespace {

/// Outlines asked about all together.
class Layouts : public CliTest {
protected:
    // As a nesting tool records it: three bars in a bin, of which one sticks out and two overlap.
    const std::string record_ = folder_.write("record.svg", R"svg(<svg viewBox="-1 -1 22 12">
<g id="bin"><path d="M0,0 L20,0 L20,10 L0,10 z" fill="#D3D3D3"/><title>bin</title></g>
<g id="items"><defs><g id="bar"><path d="M0,0 L6,0 L6,2 L0,2 z" fill-rule="nonzero"/></g></defs>
<use transform="translate(1 1), rotate(0)" xlink:href="#bar"><title>first</title></use>
<use transform="translate(4 2), rotate(90)" xlink:href="#bar"/>
<use transform="translate(17 5), rotate(0)" xlink:href="#bar"/>
<g transform="translate(12.5 7) rotate(90)"><use xlink:href="#bar" transform="scale(0.5)"/></g></g>
<text x="0" y="-0.5">density</text></svg>)svg");

    using Pairs = std::set<std::pair<std::string, std::string>>;

    /// The pairs of the results of a kind for which a member is true.
    static Pairs pairs(const Json& json, const std::string& kind, const std::string& member) {
        Pairs found;
        for (const Json& result : json.at("results")) {
            EXPECT_EQ(result.at("status"), "ok");
            if (result.at("query") == kind && result.at(member) == true) {
                found.emplace(result.at("a"), result.at("b"));
            }
        }
        return found;
    }
};

TEST_F(Layouts, OtherKindsAndHitsAlone) {
    const Json depths =
        answer({"scene", record_, "--query", "separation-vector", "-d", "0.01", "--hits-only"});
    ASSERT_TRUE(depths.is_object());
    bool is_found = false;
    for (const Json& result : depths.at("results")) {
        if (result.at("a") == "bar" && result.at("b") == "bar#2") {
            is_found = true;
            EXPECT_NEAR(result.at("length").get<double>(), 1.0, 1e-9);
        }
    }
    EXPECT_TRUE(is_found);
    EXPECT_EQ(depths.at("results").size(), 5U);
    const Json distances = answer({"scene", record_, "--query", "separation"});
    EXPECT_EQ(distances.at("results").size(), 10U);
    const Json inside = answer({"scene", record_, "--query", "containment", "--query",
                                "intersection-test", "--hits-only", "--units", "mm"});
    EXPECT_EQ(inside.at("results").size(), 8U);
}

TEST_F(Layouts, SeveralFilesAndTheStandardInput) {
    const std::string disc =
        folder_.write("disc.svg", "<svg><circle cx='.5' cy='-.5' r='.4'/></svg>");
    const Json json = answer({"scene", a_, disc, b_});
    ASSERT_TRUE(json.is_object());
    const Pairs inside = pairs(json, "containment", "inside");
    EXPECT_EQ(inside.count({"circle", "a square"}), 1U);
    EXPECT_EQ(inside.count({"a square", "circle"}), 0U);
    const auto piped = [&](const std::string& file) {
        return run_program({"scene", "-", "--json", "-"}, {{}, "", file});
    };
    EXPECT_EQ(Json::parse(piped(record_).out).at("results").size(),
              answer({"scene", record_}).at("results").size());
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"a": {"rings": [[[0, 0], [1, 0], [0, 1]]]}},
        "instances": {"x": {"shape": "a"}, "y": {"shape": "a", "pose": [0.1, 0, 0]}},
        "queries": [{"query": "intersection-test", "a": "x", "b": "y"}]})");
    const Outcome read = piped(scene);
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_EQ(Json::parse(read.out).at("results").at(0).at("intersects"), true);
    EXPECT_EQ(piped(a_).status, 0);
    expect_refused({"scene", scene, a_}, {"scene.json: a scene stands alone"});
    expect_refused({"scene", scene, "--query", "containment"}, {"--query: belongs to outlines"});
    expect_refused({"scene", "-", "-"}, {"standard input"});
}

TEST_F(Layouts, WhatIsWrongIsNamedAndTheRestAnswered) {
    const std::string file =
        folder_.write("wrong.svg",
                      "<svg><rect id='good' width='2' height='2'/><rect id='other' width='1' "
                      "height='1'/><polyline id='thin' points='0 0 1 1'/></svg>");
    const Outcome outcome = run_program({"scene", file, "--json", "-"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("wrong.svg: thin: nothing that is drawn encloses an area"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.out.find("\"inside\": true"), std::string::npos) << outcome.out;
    expect_refused({"scene", record_, "--query", "contacts"}, {"-d: required for contacts"});
    expect_refused({"scene", record_, "--query", "distance-field"}, {"--query: distance-field"});
    expect_refused({"scene", record_, "--query", "touch"}, {"--query: \"touch\" is none of"});
    expect_refused({"scene", record_, "--units", "ell"}, {"--units: \"ell\" is none of user, px"});
}

TEST_F(Layouts, UnitsScaleQueriesAndScenes) {
    const std::string page = folder_.write("page.svg",
                                           "<svg width='100mm' height='100mm' viewBox='0 0 10 10'>"
                                           "<rect width='1' height='1'/></svg>");
    const Arguments ask{"query", "separation", page, page, "--pose-a", "100,0,0"};
    EXPECT_NEAR(answer(ask).at("distance").get<double>(), 99.0, 1e-9);
    EXPECT_NEAR(answer(ask + Arguments{"--units", "mm"}).at("distance").get<double>(), 90.0, 1e-9);
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"a": {"file": "page.svg", "units": "cm"}},
        "instances": {"x": {"shape": "a"}, "y": {"shape": "a", "pose": [5, 0, 0]}},
        "queries": [{"query": "separation", "a": "x", "b": "y"}]})");
    EXPECT_NEAR(answer({"scene", scene}).at("results").at(0).at("distance").get<double>(), 4.0,
                1e-9);
}

}  // namespace
}  // namespace nearfield::test
