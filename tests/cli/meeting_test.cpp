#include "cli_test.hpp"
#include "contract.hpp"

namespace nearfield::test {
namespace {

class IntersectionTestCommand : public CliTest {};

TEST_F(IntersectionTestCommand, SaysWhetherTheShapesShareAPoint) {
    for (const auto& [pose, meets] : {std::pair{"0.5,0.5,0", true}, std::pair{"1,0.5,0", true},
                                      std::pair{"1.001,0.5,0", false}}) {
        const Json json =
            answer(squares("intersection-test", "automatic") + Arguments{"--pose-b", pose});
        ASSERT_TRUE(json.is_object()) << pose;
        EXPECT_EQ(json.at("query"), "intersection-test");
        EXPECT_EQ(json.at("intersects"), meets) << pose;
        EXPECT_EQ(json.at("technique"), "cpu");
        EXPECT_TRUE(json.at("device").is_null()) << "no device is needed for it";
        EXPECT_FALSE(json.contains("tolerance"));
        EXPECT_LT(json.at("error_bound").get<double>(), 1e-12);
        expect_number(json.at("timings_ms"), "total");
    }
}

TEST_F(IntersectionTestCommand, AsksForEachPairOfASceneOnce) {
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1], [0, 1]]]},
                   "sliver": {"rings": [[[0, 0], [9, 9], [0, 0.1]]]}},
        "instances": {"A": {"shape": "square"}, "B": {"shape": "square", "pose": [0.5, 0.5, 0]},
                      "far": {"shape": "square", "pose": [6, 2, 0]}, "long": {"shape": "sliver"}},
        "queries": [{"query": "intersection-test", "pairs": "all"},
                    {"query": "intersection-test", "a": "far", "b": "A", "technique": "cpu"}]})");
    const Json json = answer({"scene", scene});
    ASSERT_TRUE(json.is_object());
    std::vector<std::string> said;
    for (const Json& result : json.at("results")) {
        said.push_back(result.at("a").get<std::string>() + " " + result.at("b").get<std::string>() +
                       (result.at("intersects").get<bool>() ? " meet" : " are apart"));
    }
    EXPECT_EQ(said, (std::vector<std::string>{"A B meet", "A long meet", "B long meet",
                                              "far long are apart", "far A are apart"}));
}

}  // namespace
}  // namespace nearfield::test
