#include "cli_test.hpp"
#include "contract.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nearfield::test {
namespace {

/// Unit squares, B moved by (0.6, 0.3): their intersection is a rectangle of 0.4 by 0.7.
class Intersection : public CliTest {
protected:
    [[nodiscard]] Json ask(const Arguments& options) const {
        return answer(squares("intersection") + Arguments{"-d", "0.02", "--pose-b", "0.6,0.3,0"} +
                      options);
    }
};

TEST_F(Intersection, TellsItsSamplesBoxAndAreaByKind) {
    for (const std::string kind : {"volume-volume", "boundary-volume", "boundary-boundary"}) {
        SCOPED_TRACE(kind);
        const Json json = ask({"--kind", kind});
        ASSERT_TRUE(json.is_object());
        const double cell = expect_common_part(json, "intersection", 0.02, 0.0);
        const double bound = json.at("error_bound").get<double>();
        EXPECT_EQ(json.at("intersects"), true);
        EXPECT_EQ(json.at("kind"), kind);
        EXPECT_EQ(json.at("strategy"), "stencil");
        ASSERT_FALSE(json.at("samples").empty());
        EXPECT_EQ(json.at("count").get<std::size_t>(), json.at("samples").size());
        const double area = json.at("area").get<double>();
        EXPECT_NEAR(area, json.at("count").get<double>() * cell * cell, rounding);
        EXPECT_TRUE(kind != "volume-volume" || std::abs(area - 0.4 * 0.7) <= 2.2 * bound) << area;
        for (const std::size_t axis : {0U, 1U}) {
            std::vector<double> along;
            for (const Json& sample : json.at("samples")) {
                along.push_back(sample.at(axis).get<double>());
            }
            const auto [low, high] = std::minmax_element(along.begin(), along.end());
            EXPECT_EQ(json.at("box").at("min").at(axis), *low);
            EXPECT_EQ(json.at("box").at("max").at(axis), *high);
            EXPECT_NEAR(*low, axis == 0 ? 0.6 : 0.3, 2.0 * bound);
            EXPECT_NEAR(*high, 1.0, 2.0 * bound);
        }
    }
}

TEST_F(Intersection, TheKindLeftOutIsVolumeVolume) {
    Json left_out = ask({});
    Json given = ask({"--kind", "volume-volume"});
    ASSERT_TRUE(left_out.is_object() && given.is_object());
    left_out.erase("timings_ms");
    given.erase("timings_ms");
    EXPECT_EQ(left_out, given);
}

TEST_F(Intersection, EveryStrategyIsTold) {
    const Json expected = ask({});
    ASSERT_TRUE(expected.is_object());
    for (const auto& strategy : {"stencil", "blend", "logic-op", "depth"}) {
        const Json json = ask({"--strategy", strategy});
        ASSERT_TRUE(json.is_object());
        EXPECT_EQ(json.at("strategy"), strategy);
        EXPECT_EQ(json.at("samples"), expected.at("samples")) << strategy;
    }
}

TEST_F(Intersection, AShapeInAHoleDoesNotIntersect) {
    const std::string frame = folder_.write(
        "frame.wkt", "POLYGON ((-2 -2, 4 -2, 4 4, -2 4, -2 -2), (-1 -1, 3 -1, 3 3, -1 3, -1 -1))");
    const Json json = answer({"query", "intersection", a_, frame, "-d", "0.05"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json.at("intersects"), false);
    EXPECT_EQ(json.at("count"), 0);
    EXPECT_EQ(json.at("area"), 0.0);
    EXPECT_TRUE(json.at("box").is_null());
}

}  // namespace
}  // namespace nearfield::test
