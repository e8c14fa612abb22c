#include "cli_test.hpp"
#include "contract.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>

namespace nearfield::test {
namespace {

class Penetration : public CliTest {
protected:
    [[nodiscard]] Json ask(const std::string& pose_b, const Arguments& options = {}) const {
        return answer(squares("penetration") + Arguments{"-d", "0.03", "--pose-b", pose_b} +
                      options);
    }
};

/// The right and the upper side of A reach into B, at most 0.4 deep.
TEST_F(Penetration, TellsEachPointWithItsWayOut) {
    const Json json = ask("0.6,0.3,0");
    ASSERT_TRUE(json.is_object());
    const double cell = expect_common_part(json, "penetration", 0.03, 0.03 * std::numbers::sqrt2);
    EXPECT_GT(cell, 0.0);
    EXPECT_EQ(json.at("intersects"), true);
    ASSERT_GT(json.at("records").size(), 20U);
    EXPECT_EQ(json.at("count").get<std::size_t>(), json.at("records").size());
    double deepest = 0.0;
    for (const Json& record : json.at("records")) {
        const double depth = record.at("depth").get<double>();
        deepest = std::max(deepest, depth);
        for (const std::size_t axis : {0U, 1U}) {
            EXPECT_NEAR(record.at("point").at(axis).get<double>() +
                            depth * record.at("direction").at(axis).get<double>(),
                        record.at("nearest").at(axis).get<double>(), rounding)
                << record;
        }
        EXPECT_LT(record.at("feature").at("edge"), 4) << record;
        EXPECT_TRUE(record.at("unique").is_boolean()) << record;
    }
    EXPECT_EQ(json.at("deepest").at("depth").get<double>(), deepest);
    EXPECT_LE(deepest, 0.4 + rounding);
    EXPECT_GE(deepest, 0.4 - json.at("error_bound").get<double>());
}

TEST_F(Penetration, OfVerticesIsThatOfTheOneInside) {
    const Json json = ask("0.6,0.3,0", {"--points", "vertices"});
    ASSERT_TRUE(json.is_object());
    expect_common_part(json, "penetration", 0.03, 0.03 * std::numbers::sqrt2);
    EXPECT_EQ(json.at("count"), 1);
    ASSERT_EQ(json.at("records").size(), 1U);
    const Json& record = json.at("records").front();
    EXPECT_EQ(record.at("point"), Json({1.0, 1.0}));
    EXPECT_NEAR(record.at("depth").get<double>(), 0.3, rounding);
    EXPECT_EQ(record.at("direction"), Json({0.0, 1.0}));
    EXPECT_EQ(record.at("feature"), (Json{{"edge", 2}}));
    EXPECT_EQ(record.at("unique"), true);
    for (const auto& key : {"point", "depth", "direction"}) {
        EXPECT_EQ(json.at("deepest").at(key), record.at(key)) << key;
    }
}

TEST_F(Penetration, IsEmptyWhereSquaresOnlyTouchOrAreApart) {
    for (const auto& [pose, intersects] :
         {std::pair{"1,0.25,0", true}, std::pair{"1.001,0.25,0", false}}) {
        const Json json = ask(pose);
        ASSERT_TRUE(json.is_object());
        EXPECT_EQ(json.at("intersects"), intersects);
        EXPECT_EQ(json.at("count"), 0);
        EXPECT_TRUE(json.at("records").empty());
        EXPECT_TRUE(json.at("deepest").is_null());
        EXPECT_TRUE(intersects || json.at("regions").empty());
    }
}

TEST_F(Penetration, TellsItsTilesOnRequest) {
    const Arguments query =
        squares("penetration", "raster") + Arguments{"-d", "0.002", "--pose-b", "0.6,0.3,0"};
    EXPECT_FALSE(answer(query).contains("tiles"));
    const Json json = answer(query + Arguments{"--tiles"});
    ASSERT_TRUE(json.is_object());
    ASSERT_GT(json.at("tiles").size(), 1U);
    const Json& region = json.at("regions").at(0);
    for (const Json& tile : json.at("tiles")) {
        EXPECT_EQ(tile.at("technique"), "raster");
        EXPECT_EQ(tile.at("side"), "a");
        EXPECT_EQ(tile.at("tile_batch"), 0);
        for (const std::size_t axis : {0U, 1U}) {
            EXPECT_GE(tile.at("min").at(axis).get<double>(),
                      region.at("min").at(axis).get<double>() - rounding);
            EXPECT_LE(tile.at("max").at(axis).get<double>(),
                      region.at("max").at(axis).get<double>() + rounding);
        }
    }
    EXPECT_TRUE(answer(squares("penetration", "cpu") + Arguments{"-d", "0.05", "--tiles"})
                    .at("tiles")
                    .empty());
}

/// Rotated by 90 degrees counter-clockwise about its origin, the square is to the left of it.
TEST_F(Penetration, PosesTurnCounterClockwiseInDegreesBeforeTheyMove) {
    const Json json = ask("1.6,0.3,90", {"--points", "vertices"});
    ASSERT_TRUE(json.is_object());
    ASSERT_EQ(json.at("count"), 1);
    EXPECT_NEAR(json.at("deepest").at("depth").get<double>(), 0.3, rounding);
    EXPECT_NEAR(json.at("deepest").at("direction").at(1).get<double>(), 1.0, rounding);
    EXPECT_EQ(json.at("records").front().at("feature").at("edge"), 1);
}

}  // namespace
}  // namespace nearfield::test
