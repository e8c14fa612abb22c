#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/folder.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/values.hpp>

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

std::string scene_text(const std::string& query) {
    return R"({"shapes": {"tri": {"rings": [[[0, 0], [4, 0], [0, 3]]]}, "disk": {"file": "b.wkt"}},
 "instances": {"one": {"shape": "tri", "pose": [1, -2, 90]}, "two": {"shape": "disk"}},
 "queries": [)" +
           query + "]}";
}

TEST(ToolsScene, ReadsShapesInstancesAndQueries) {
    const test_support::Folder folder;
    folder.write("b.wkt", "POLYGON((0 0, 1 0, 0 1))");
    const Scene scene = read_scene(folder.write(
        "s.json", scene_text(R"({"query": "penetration", "a": "one", "b": "two", "tolerance": 0.5,
                       "points": "vertices", "records": false},
                      {"query": "intersection", "a": "two", "b": "one", "tolerance": 1, "strategy": "depth",
                       "kind": "boundary-volume", "technique": "raster"},
                      {"query": "distance-field", "a": "two", "b": "two", "tolerance": 2,
                       "rect": [0, 1, 2, 3]})")));
    ASSERT_EQ(scene.shapes.size(), 2U);
    ASSERT_EQ(scene.instances.size(), 2U);
    ASSERT_EQ(scene.queries.size(), 3U);
    const SceneInstance& one = scene.instances[scene.queries[0].a];
    EXPECT_EQ(one.name, "one");
    EXPECT_EQ(one.pose.translation, (Vector2{1, -2}));
    EXPECT_DOUBLE_EQ(one.pose.angle, std::numbers::pi / 2);
    EXPECT_EQ(scene.shapes[one.shape].rings, (std::vector<Ring>{{{0, 0}, {4, 0}, {0, 3}}}));
    const SceneInstance& two = scene.instances[scene.queries[0].b];
    EXPECT_EQ(scene.shapes[two.shape].rings, (std::vector<Ring>{{{0, 0}, {1, 0}, {0, 1}}}));
    EXPECT_EQ(scene.queries[0].request.points, PenetrationPoints::vertices);
    EXPECT_FALSE(scene.queries[0].request.records);
    EXPECT_EQ(scene.queries[1].request.kind, IntersectionKind::boundary_volume);
    EXPECT_EQ(scene.queries[1].request.strategy, IntersectionStrategy::depth);
    ASSERT_TRUE(scene.queries[2].request.rectangle.has_value());
    EXPECT_EQ(scene.queries[2].request.rectangle->max, (Vector2{2, 3}));
}

TEST(ToolsScene, ReadsWhatADistanceFieldIsAskedFor) {
    const test_support::Folder folder;
    folder.write("b.wkt", "POLYGON((0 0, 1 0, 0 1))");
    const std::string begin =
        R"({"query": "distance-field", "a": "two", "b": "two", "tolerance": 2, )";
    const auto read = [&](const std::string& members) {
        return read_scene(folder.write("s.json", scene_text(begin + members + "}")));
    };
    const Scene scene =
        read(R"("sign": "feature-bit", "gradient": "blended", "values": false, "features": true,
                "gradients": true, "at": [[1, 2], [3, 4]])");
    const QueryRequest& request = scene.queries.at(0).request;
    EXPECT_EQ(request.sign, SignEncoding::feature_bit);
    EXPECT_EQ(request.gradient, GradientMethod::blended);
    EXPECT_FALSE(request.values);
    EXPECT_TRUE(request.features);
    EXPECT_TRUE(request.gradients);
    EXPECT_EQ(request.at, (std::vector<Vector2>{{1, 2}, {3, 4}}));
    const std::string file = folder.path("s.json") + ": queries[0].";
    EXPECT_EQ(input_error([&] { return read(R"("at": [[1]])"); }),
              file + "at[0]: expected [x, y] (two numbers)");
    EXPECT_EQ(input_error([&] { return read(R"("gradient": "blended")"); }),
              file + "gradient: there is no gradient asked for, by gradients or at");
}

TEST(ToolsScene, ErrorsNameTheFileAndThePlace) {
    const test_support::Folder folder;
    folder.write("b.wkt", "POLYGON((0 0, 1 0, 0 1))");
    const std::string file = folder.path("s.json");
    const auto error_of_query = [&](const std::string& query) {
        folder.write("s.json", scene_text(query));
        return input_error([&] { return read_scene(file); });
    };
    const std::string ends = R"("a": "one", "b": "two")";
    EXPECT_EQ(error_of_query(R"({"query": "penetration", "tolerance": 0, )" + ends + "}"),
              file + ": queries[0].tolerance: expected a number greater than 0");
    EXPECT_EQ(error_of_query(R"({"query": "penetration", )" + ends + "}"),
              file + ": queries[0]: has no \"tolerance\"");
    EXPECT_EQ(error_of_query(R"({"query": "penetration", "tolerance": 1, "a": "six", "b": "two"})"),
              file + ": queries[0].a: there is no instance \"six\"");
    EXPECT_EQ(
        error_of_query(R"({"query": "penetration", "tolerance": 1, "rect": [], )" + ends + "}"),
        file + ": queries[0].rect: is not known here");
    EXPECT_EQ(error_of_query(R"({"query": "separation", "tolerance": 1, "contact_distance": 1, )" +
                             ends + "}"),
              file + ": queries[0].contact_distance: is not known here");
    EXPECT_EQ(
        error_of_query(R"({"query": "separation", "tolerance": 1, "tolerance": 2, )" + ends + "}"),
        file + ": an object has two members \"tolerance\"");
    EXPECT_EQ(error_of_query(R"({"query": "contacts", "tolerance": 1, "contact_distance": 0, )" +
                             ends + "}"),
              file + ": queries[0].contact_distance: expected a number greater than 0");
    EXPECT_EQ(
        error_of_query(R"({"query": "penetration", "tolerance": 1, "pairs": "all", )" + ends + "}"),
        file + ": queries[0].a: stands beside \"pairs\"");
    EXPECT_EQ(error_of_query("7"), file + ": queries[0]: not an object but a number");
    folder.write("s.json",
                 R"({"shapes": {"x": {"file": "none.wkt"}}, "instances": {}, "queries": []})");
    EXPECT_EQ(input_error([&] { return read_scene(file); }),
              folder.path("none.wkt") + ": cannot be opened: No such file or directory");
    folder.write("s.json", R"({"shapes": {"x": {}}, "instances": {}, "queries": []})");
    EXPECT_EQ(input_error([&] { return read_scene(file); }),
              file + ": shapes.x: needs either \"file\" or \"rings\"");
}

TEST(ToolsValues, PosesAreThreeFiniteNumbersAndNothingElse) {
    const Pose pose = to_pose(parse_pose("-1.5,2e2,720", "--pose-a"));
    EXPECT_EQ(pose.translation, (Vector2{-1.5, 200}));
    EXPECT_EQ(pose.angle, 0.0);
    EXPECT_DOUBLE_EQ(to_pose(parse_pose("0,+0,-90", "--pose-a")).angle, -std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(to_end_pose({0, 0, 450}, 90).angle, 2.5 * std::numbers::pi);
    for (const char* const text :
         {"", "1", "1,2", "1,2,3,4", "1,2,", ",,", "1,2,x", "1,2,3 ", " 1,2,3", "nan,0,0",
          "0,inf,0", "1e999,0,0", "0x1,0,0", "1;2;3", "+-1,0,0"}) {
        EXPECT_EQ(input_error([&] {
                      return parse_pose(text, "--pose-a");
                  }).rfind(std::string("--pose-a: \"") + text + "\": expected X,Y,DEGREES", 0),
                  0U)
            << text;
    }
}

TEST(ToolsValues, CountsAreWholeDecimalNumbersInARange) {
    EXPECT_EQ(parse_count("1", "--n", {1, 256}), 1U);
    EXPECT_EQ(parse_count("256", "--n", {1, 256}), 256U);
    EXPECT_EQ(parse_count("0", "--n", {0, 32}), 0U);
    EXPECT_EQ(parse_count("010", "--n", {1, 256}), 10U);
    EXPECT_EQ(parse_count("1e6", "--n", {1, 1'000'000}), 1'000'000U);
    EXPECT_EQ(parse_count("4294967295", "--n", {0, UINT32_MAX}), UINT32_MAX);
    for (const char* const text : {"", "x", "0x4", "+5", " 5", "5 ", "5x", "1.5", "nan", "inf",
                                   "-inf", "-x", "1,0", "1e-1"}) {
        EXPECT_EQ(input_error([&] {
                      return parse_count(text, "--n", {1, 256});
                  }),
                  std::string("--n: \"") + text + "\" is not a whole number in decimal notation");
    }
    for (const char* const text : {"0", "-0", "-1", "257", "1e999", "18446744073709551617"}) {
        EXPECT_EQ(input_error([&] {
                      return parse_count(text, "--n", {1, 256});
                  }),
                  std::string("--n: \"") + text + "\" is out of range 1 to 256");
    }
    EXPECT_EQ(input_error([] {
                  return parse_count("-0", "--n", {0, 32});
              }),
              "--n: \"-0\" is out of range 0 to 32");
}

TEST(ToolsValues, TolerancesAndRectanglesAreChecked) {
    EXPECT_EQ(parse_positive("2.5e-3", "-d"), 2.5e-3);
    for (const char* const text : {"", "0", "-1", "nan", "inf", "1e999", "1 ", "1,0", "1m"}) {
        EXPECT_EQ(input_error([&] { return parse_positive(text, "-d"); }),
                  std::string("-d: \"") + text + "\": expected a finite number greater than 0");
    }
    const Rectangle rectangle = parse_rectangle("-1,-2,3,4", "--rect");
    EXPECT_EQ(rectangle.min, (Vector2{-1, -2}));
    EXPECT_EQ(rectangle.max, (Vector2{3, 4}));
    EXPECT_EQ(input_error([] { return parse_rectangle("0,0,0,1", "--rect"); }),
              "--rect: \"0,0,0,1\": expected X0 < X1 and Y0 < Y1");
}

TEST(ToolsRequest, WhatThisVersionLacksIsRefusedByName) {
    EXPECT_EQ(input_error([] { return parse_query_type("depth", "query"); }),
              "query: \"depth\" is none of penetration, intersection, distance-field, contacts, "
              "closest-point, separation, intersection-test, time-of-impact, separation-vector");
    EXPECT_EQ(input_error([] { return parse_technique("gpu", "--technique"); }),
              "--technique: \"gpu\" is none of automatic, raster, compute, cpu");
    EXPECT_EQ(input_error([] { return parse_strategy("blending", "--strategy"); }),
              "--strategy: \"blending\" is none of stencil, blend, logic-op, depth");
    EXPECT_EQ(parse_technique("cpu", "--technique"), Technique::cpu);
    EXPECT_EQ(parse_technique("compute", "--technique"), Technique::compute);
}

}  // namespace
}  // namespace nearfield::tools
