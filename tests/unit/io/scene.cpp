#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/folder.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/values.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
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

TEST(ToolsScene, BadEntriesAreRecordedWhereAsked) {
    const test_support::Folder folder;
    folder.write("good.wkt", "GEOMETRYCOLLECTION(POINT(1 2),POLYGON((0 0,4 0,0 3)))");
    const std::string file = folder.write("s.json", R"({
        "shapes": {"bare": {"rings": [[]]}, "good": {"file": "good.wkt"}, "none": {"file": "none.wkt"}},
        "instances": {"a": {"shape": "good"}, "b": {"shape": "box"}, "c": {"shape": "none"}},
        "queries": [{"query": "separation", "a": "a", "b": "c"},
                    {"query": "separation", "a": "a", "b": "x"},
                    {"query": "depth", "a": "a", "b": 7},
                    {"query": "penetration", "a": "a", "b": "b"}, 7]})");
    EXPECT_NE(input_error([&] { return read_scene(file); }), "no error");
    const Scene scene = read_scene(file, BadEntries::recorded);
    ASSERT_EQ(scene.shapes.size(), 3U);
    EXPECT_EQ(scene.shapes[0].problem, file + ": shapes.bare.rings[0]: an empty ring");
    EXPECT_EQ(scene.shapes[1].problem, "");
    EXPECT_EQ(scene.shapes[1].note, file + ": shapes.good: " + folder.path("good.wkt") +
                                        ": skipped what holds no area: POINT (1)");
    EXPECT_EQ(scene.shapes[1].rings.size(), 1U);
    EXPECT_EQ(scene.shapes[2].problem, file + ": shapes.none: " + folder.path("none.wkt") +
                                           ": cannot be opened: No such file or directory");
    ASSERT_EQ(scene.instances.size(), 3U);
    EXPECT_EQ(scene.instances[0].problem, "");
    EXPECT_EQ(scene.instances[1].problem, file + ": instances.b.shape: there is no shape \"box\"");
    EXPECT_EQ(scene.instances[2].problem, "") << "its shape is what is bad";
    ASSERT_EQ(scene.queries.size(), 5U);
    EXPECT_EQ(scene.queries[0].problem, "");
    EXPECT_EQ(scene.queries[1].problem, file + ": queries[1].b: there is no instance \"x\"");
    EXPECT_EQ(scene.queries[1].kind + scene.queries[1].name_a + scene.queries[1].name_b,
              "separationax");
    EXPECT_EQ(scene.queries[2].problem.rfind(file + ": queries[2].query: \"depth\" is none", 0),
              0U);
    EXPECT_EQ(scene.queries[2].name_b, "");
    EXPECT_EQ(scene.queries[3].problem, file + ": queries[3]: has no \"tolerance\"");
    EXPECT_EQ(scene.queries[4].problem, file + ": queries[4]: not an object but a number");
}

TEST(ToolsScene, AMisspeltMemberRefusesTheSceneWhateverBecomesOfBadEntries) {
    const test_support::Folder folder;
    folder.write("b.wkt", "POLYGON((0 0, 1 0, 0 1))");
    const std::string file = folder.write(
        "s.json", scene_text(R"({"query": "contacts", "a": "one", "b": "two", "tolerance": -1,
                                 "contact_distanze": 1})"));
    EXPECT_EQ(input_error([&] { return read_scene(file, BadEntries::recorded); }),
              file + ": queries[0].contact_distanze: is not known here");
}

TEST(ToolsValues, PosesAreThreeFiniteNumbersAndNothingElse) {
    for (const char* const text : {"-1.5,2e2,720", "-1.5, 2e2, 720", " -1.5 ,\t2e2 , 720 "}) {
        EXPECT_EQ(parse_pose(text, "--pose-a").x, -1.5) << text;
        EXPECT_EQ(parse_pose(text, "--pose-a").y, 200.0) << text;
        EXPECT_EQ(parse_pose(text, "--pose-a").degrees, 720.0) << text;
    }
    const Pose pose = to_pose(parse_pose("-1.5,2e2,720", "--pose-a"));
    EXPECT_EQ(pose.translation, (Vector2{-1.5, 200}));
    EXPECT_EQ(pose.angle, 0.0);
    EXPECT_DOUBLE_EQ(to_pose(parse_pose("0,+0,-90", "--pose-a")).angle, -std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(to_end_pose({0, 0, 450}, 90).angle, 2.5 * std::numbers::pi);
    for (const char* const text :
         {"", "1", "1,2", "1,2,3,4", "1,2,", ",,", "1,2,x", "1 2 3", "1,2 3", "1, ,3", "nan,0,0",
          "0,inf,0", "1e999,0,0", "0x1,0,0", "1;2;3", "+-1,0,0"}) {
        EXPECT_EQ(input_error([&] {
                      return parse_pose(text, "--pose-a");
                  }).rfind(std::string("--pose-a: \"") + text + "\": expected X,Y,DEGREES", 0),
                  0U)
            << text;
    }
}

TEST(ToolsValues, AnglesTooLargeToMeanAnythingAreRefused) {
    for (const char* const text : {"0,0,8589934592", "0,0,-8589934592"}) {
        EXPECT_EQ(std::abs(parse_pose(text, "--pose-a").degrees), largest_degrees);
    }
    for (const char* const text : {"0,0,8589934593", "0,0,-1e10", "0,0,1e300"}) {
        const std::string error = input_error([&] { return parse_pose(text, "--end-pose-b"); });
        EXPECT_EQ(error.rfind(std::string("--end-pose-b: \"") + text + "\": an angle of ", 0), 0U)
            << error;
        EXPECT_NE(error.find("the largest is 8589934592"), std::string::npos) << error;
    }
    const test_support::Folder folder;
    for (const char* const key : {"pose", "end_pose"}) {
        const std::string file = folder.write(
            "s.json", std::string(R"({"shapes": {"s": {"rings": [[[0, 0], [1, 0], [0, 1]]]}},
                "instances": {"i": {"shape": "s", ")") +
                          key + R"(": [0, 0, 1e10]}}, "queries": []})");
        const std::string error = input_error([&] { return read_scene(file); });
        EXPECT_EQ(error.rfind(file + ": instances.i." + key + ": an angle of 1e+10 degrees", 0), 0U)
            << error;
    }
}

TEST(ToolsValues, TheUsualToleranceIsOneThatTheLibraryAllows) {
    const std::vector<Ring> small{{{0, 0}, {1, 0}, {1, 2}}};
    const std::vector<Ring> large{{{10, 0}, {50, 0}, {10, 5}}, {{9, 9}, {9, 10}, {8, 9}}};
    EXPECT_DOUBLE_EQ(usual_tolerance({small, 0.0, {}}, {large, 0.0, {}}), 0.042);
    EXPECT_DOUBLE_EQ(usual_tolerance({large, 0.0, {}}, {small, 0.0, {3, 4}}), 0.042);
    EXPECT_GE(usual_tolerance({small, 0.0, {1e11, 0}}, {large, 0.0, {}}),
              4096 * std::numeric_limits<double>::epsilon() * 1e11);
    const double deviated = usual_tolerance({small, 0.5, {}}, {large, 0.25, {}});
    EXPECT_GE(max_deviation * deviated, 0.75);
    EXPECT_LE(deviated, 3.1);
}

TEST(ToolsValues, CountsAreWholeDecimalNumbersInARange) {
    EXPECT_EQ(parse_count("1", "--n", {1, 256}), 1U);
    EXPECT_EQ(parse_count("256", "--n", {1, 256}), 256U);
    EXPECT_EQ(parse_count("0", "--n", {0, 32}), 0U);
    EXPECT_EQ(parse_count("010", "--n", {1, 256}), 10U);
    EXPECT_EQ(parse_count("1e6", "--n", {1, 1'000'000}), 1'000'000U);
    EXPECT_EQ(parse_count("4294967295", "--n", {0, UINT32_MAX}), UINT32_MAX);
    for (const char* const text :
         {"",   "x",  "0x4", "0X4", "0b1", "+5",  "++5", "--5", " 5",   "\t5", "5 ",   "5x",
          "5e", "5u", "1.5", "1,0", "1'0", "1_0", "nan", "inf", "-inf", "-x",  "1e-1", "true"}) {
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
    for (const char* const text : {"", "0", "-1", "nan", "inf", "infinity", "1e999", "1e-999",
                                   "0x1", "1 ", " 1", "++1", "+-1", "1,0", "1e", ".", "1m"}) {
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
    EXPECT_EQ(input_error([] { return parse_name<QueryType>("depth", "query"); }),
              "query: \"depth\" is none of penetration, intersection, distance-field, contacts, "
              "closest-point, separation, intersection-test, time-of-impact, separation-vector, "
              "containment");
    EXPECT_EQ(input_error([] { return parse_name<Technique>("gpu", "--technique"); }),
              "--technique: \"gpu\" is none of automatic, raster, compute, cpu");
    EXPECT_EQ(
        input_error([] { return parse_name<IntersectionStrategy>("blending", "--strategy"); }),
        "--strategy: \"blending\" is none of stencil, blend, logic-op, depth");
    EXPECT_EQ(parse_name<Technique>("cpu", "--technique"), Technique::cpu);
    EXPECT_EQ(parse_name<Technique>("compute", "--technique"), Technique::compute);
}

}  // namespace
}  // namespace nearfield::tools
