#include "cli_test.hpp"

#include <cmath>

namespace nearfield::test {
namespace {

class Svg : public CliTest {
protected:
    // As displayed: B is to the right of A and lower, because SVG's y axis points down.
    Svg()
        : circle_a_(folder_.write("a.svg", "<svg><circle r='2'/></svg>")),
          circle_b_(folder_.write(
              "b.svg",
              "<svg>\n<g transform='translate(2 0)'><path transform='translate(0,1.5) scale(.5)'\n"
              " d='M-2 0a2 2 0 112 2 2 2 0 01-2-2'/></g></svg>")) {}

    std::string circle_a_;
    std::string circle_b_;
};

TEST_F(Svg, PenetrationOfCirclesIsThatOfTheCurves) {
    for (const Arguments& more : {Arguments{}, Arguments{"--deviation", "0.002"}}) {
        const Json json =
            answer(Arguments{"query", "penetration", circle_b_, circle_a_, "-d", "0.08"} + more);
        ASSERT_FALSE(json.is_null());
        // B has radius 1 and centre (2, -1.5), 2.5 from A's centre: the depth is 0.5.
        const double bound = json.at("error_bound").get<double>();
        const double deviation = more.empty() ? 0.08 / 16.0 : 0.002;
        EXPECT_NEAR(bound, 0.08 * (std::sqrt(0.5) + 1.0 / 1024.0) + 2.0 * deviation, 1e-9);
        EXPECT_NEAR(json.at("deepest").at("depth").get<double>(), 0.5, bound);
        const Json& point = json.at("deepest").at("point");
        EXPECT_NEAR(point.at(0).get<double>(), 2.0 - 0.8, 0.3);
        EXPECT_NEAR(point.at(1).get<double>(), -1.5 + 0.6, 0.3);
    }
}

TEST_F(Svg, PicturesDrawTheRingsHoweverCoarse) {
    const std::string image = folder_.path("out.png");
    const Json json = answer({"query", "penetration", circle_b_, circle_a_, "-d", "2",
                              "--deviation", "0.25", "--image", image});
    EXPECT_FALSE(json.is_null());
}

TEST_F(Svg, ScenesTessellateByTheirTolerances) {
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"a": {"file": "a.svg"}, "b": {"file": "b.svg", "deviation": 0.001}},
        "instances": {"a": {"shape": "a"}, "b": {"shape": "b"}},
        "queries": [{"query": "penetration", "a": "a", "b": "b", "tolerance": 0.1}]})");
    EXPECT_FALSE(answer({"bench", "--scene", scene}).is_null());
    const std::string coarse = folder_.write("coarse.json", R"({
        "shapes": {"a": {"file": "a.svg"}, "b": {"file": "b.svg", "deviation": 0.05}},
        "instances": {"a": {"shape": "a"}, "b": {"shape": "b"}},
        "queries": [{"query": "penetration", "a": "a", "b": "b", "tolerance": 0.1}]})");
    expect_refused({"bench", "--scene", coarse}, {"queries[0]", "0.05 (B)", "tolerance 0.1"});
    const std::string straight = folder_.write("straight.json", R"({
        "shapes": {"a": {"rings": [[[0, 0], [1, 0], [0, 1]]], "deviation": 0.05}},
        "instances": {}, "queries": []})");
    EXPECT_EQ(run_program({"scene", straight}).status, 0);
    const std::string unused = folder_.write("unused.json", R"({
        "shapes": {"a": {"file": "a.svg"}}, "instances": {}, "queries": []})");
    expect_refused({"bench", "--scene", unused}, {"shapes.a", "needs \"deviation\""});
}

TEST_F(Svg, BadInputIsRefusedByNameAndPlace) {
    const auto expect_bad = [&](const std::string& name, const std::string& text,
                                const std::vector<std::string>& parts) {
        expect_refused({"query", "penetration", folder_.write(name, text), b_, "-d", "0.1"}, parts);
    };
    expect_bad("text.svg", "<svg>\n <text>x</text></svg>",
               {"text.svg:1:2: svg: has no outline, only text (1)"});
    expect_bad("flag.path", "M0 0\nA1 1 0 3 1 2 2", {"flag.path:2:8: expected a flag"});
    expect_bad("far.svg", "<svg><circle cx='1e11' r='1'/></svg>", {"far.svg", "deviation"});
    const Arguments circles{"query", "penetration", circle_a_, circle_b_, "-d", "0.1"};
    expect_refused(circles + Arguments{"--deviation", "0.06"}, {"0.06 (A)", "0.06 (B)", "0.25"});
    expect_refused(circles + Arguments{"--deviation", "0"}, {"--deviation", "greater than 0"});
    expect_refused(circles + Arguments{"--deviation", "1e-18"}, {"a.svg", "double precision"});
    // Straight edges have no use for a deviation; their bound is as without.
    const Json straight = answer(squares("penetration") + Arguments{"-d", "0.1"});
    const Json stated =
        answer(squares("penetration") + Arguments{"-d", "0.1", "--deviation", "0.01"});
    EXPECT_EQ(stated.at("error_bound"), straight.at("error_bound"));
}

}  // namespace
}  // namespace nearfield::test
