#include "cli_test.hpp"
#include "contract.hpp"

namespace nearfield::test {
namespace {

class ContainmentCommand : public CliTest {
protected:
    /// The unit square in a room with a hole.
    [[nodiscard]] Arguments in_room(const std::string& pose) const {
        const std::string room = folder_.write(
            "room.wkt", "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0), (6 2, 8 2, 8 6, 6 6, 6 2))");
        return {"query", "containment", a_, room, "--pose-a", pose};
    }
};

TEST_F(ContainmentCommand, SaysWhetherAIsInsideAndHowFarFromTheBoundary) {
    const Json json = answer(in_room("3.5,0.75,0"));
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("query"), "containment");
    EXPECT_EQ(json.at("inside"), true);
    EXPECT_EQ(json.at("intersects"), true);
    EXPECT_EQ(json.at("clearance"), 0.75);
    EXPECT_EQ(json.at("point_a").at(1), 0.75);
    EXPECT_EQ(json.at("point_b").at(1), 0.0);
    EXPECT_EQ(json.at("direction"), (Json{0.0, -1.0}));
    EXPECT_EQ(json.at("feature_a").size(), 1U);
    EXPECT_EQ(json.at("feature_b").at("edge"), 0);
    EXPECT_EQ(json.at("unique"), false);
    EXPECT_EQ(json.at("technique"), "cpu");
    EXPECT_TRUE(json.at("device").is_null()) << "no device is needed for it";
    EXPECT_LT(json.at("error_bound").get<double>(), 1e-12);
    for (const char* key : {"tolerance", "cell", "sampled_distance"}) {
        EXPECT_FALSE(json.contains(key)) << key;
    }
}

TEST_F(ContainmentCommand, TouchingIsInsideAndWhatSticksOutIsNot) {
    for (const auto& [pose, inside] :
         {std::pair{"0,3,0", true}, std::pair{"5,3,0", true}, std::pair{"5.001,3,0", false},
          std::pair{"6.5,3,0", false}, std::pair{"20,3,0", false}}) {
        const Json json = answer(in_room(pose));
        ASSERT_TRUE(json.is_object()) << pose;
        EXPECT_EQ(json.at("inside"), inside) << pose;
        EXPECT_EQ(json.at("clearance"), 0.0) << pose;
        EXPECT_EQ(json.at("point_a").is_null(), !inside) << pose;
        EXPECT_EQ(json.at("point_b").is_null(), !inside) << pose;
        for (const char* key : {"direction", "feature_a", "feature_b"}) {
            EXPECT_TRUE(json.at(key).is_null()) << pose << ' ' << key;
        }
    }
}

TEST_F(ContainmentCommand, SummarisesAndDraws) {
    const std::string image = folder_.path("out.png");
    for (const auto& [pose, line] : {std::pair{"3.5,0.75,0", "clearance         0.75\n"},
                                     std::pair{"0,3,0", "touching at       (0, "},
                                     std::pair{"20,3,0", "A inside B        no\n"}}) {
        const Arguments words = in_room(pose) + Arguments{"--image", image};
        const Outcome outcome = run_program(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_NE(outcome.out.find(line), std::string::npos) << outcome.out;
    }
}

TEST_F(ContainmentCommand, AsksForBothOrdersOfThePairsOfAScene) {
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1], [0, 1]]]},
                   "room": {"rings": [[[0, 0], [5, 0], [5, 5], [0, 5]]]}},
        "instances": {"A": {"shape": "square", "pose": [2, 1, 0]}, "B": {"shape": "room"},
                      "far": {"shape": "square", "pose": [9, 2, 0]}},
        "queries": [{"query": "containment", "pairs": "all"},
                    {"query": "containment", "a": "far", "b": "B", "technique": "cpu"}]})");
    const Json json = answer({"scene", scene});
    ASSERT_TRUE(json.is_object());
    std::vector<std::string> said;
    for (const Json& result : json.at("results")) {
        said.push_back(result.at("a").get<std::string>() + " " + result.at("b").get<std::string>() +
                       (result.at("inside").get<bool>() ? " inside" : " not"));
    }
    EXPECT_EQ(said, (std::vector<std::string>{"A B inside", "B A not", "far B not"}));
    EXPECT_EQ(json.at("results").at(0).at("clearance"), 1.0);
}

}  // namespace
}  // namespace nearfield::test
