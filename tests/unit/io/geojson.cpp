#include "support.hpp"

#include <gtest/gtest.h>
#include <tools/io/simple_features.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

const std::string triangle = "[[[0, 0], [4, 0], [0, 3], [0, 0]]]";

std::string error_of(const std::string& text) {
    return input_error([&] { return parse_geojson(text, "a.geojson"); });
}

std::string polygon(const std::string& coordinates) {
    return R"({"type": "Polygon", "coordinates": )" + coordinates + "}";
}

TEST(ToolsGeojson, ReadsEveryKindThatHoldsPolygons) {
    const std::vector<Ring> one{{{0, 0}, {4, 0}, {0, 3}, {0, 0}}};
    const std::vector<Ring> two{one[0], one[0]};
    const std::string feature =
        R"({"type": "Feature", "properties": null, "geometry": )" + polygon(triangle) + "}";
    EXPECT_EQ(parse_geojson(polygon(triangle), "f"), one);
    EXPECT_EQ(parse_geojson(feature, "f"), one);
    EXPECT_EQ(
        parse_geojson(
            R"({"type": "MultiPolygon", "coordinates": [)" + triangle + "," + triangle + "]}", "f"),
        two);
    EXPECT_EQ(
        parse_geojson(
            R"({"type": "FeatureCollection", "features": [)" + feature + "," + feature + "]}", "f"),
        two);
    const std::string collection = R"({"type": "GeometryCollection", "geometries": [)" +
                                   polygon(triangle) + "," + polygon(triangle) + "]}";
    EXPECT_EQ(parse_geojson(collection, "f"), two);
    const std::string nested =
        R"({"type": "GeometryCollection", "geometries": [)" + collection + "]}";
    EXPECT_EQ(parse_geojson(R"({"type": "Feature", "geometry": )" + nested + "}", "f"), two);
}

TEST(ToolsGeojson, SequencesHaveADocumentALine) {
    const std::vector<Ring> two{{{0, 0}, {4, 0}, {0, 3}, {0, 0}}, {{0, 0}, {4, 0}, {0, 3}, {0, 0}}};
    const std::string one = polygon(triangle);
    const std::string feature = R"({"type": "Feature", "geometry": )" + one + "}";
    for (const std::string& text :
         {one + "\n" + feature, one + "\r\n\r\n" + feature + "\r\n\n",
          "\n" + feature + "\n  " + one, "\x1E" + one + "\n\x1E" + feature + "\n",
          " \x1E\n{\n\"type\": \"Polygon\",\n\"coordinates\": " + triangle + "\n}\n\x1E" +
              feature}) {
        EXPECT_EQ(parse_geojson(text, "f"), two) << text;
    }
    // One document, whose first line is not complete, or the last.
    const std::vector<Ring> single{two.front()};
    EXPECT_EQ(parse_geojson("{\n\"type\": \"Polygon\",\n\"coordinates\": " + triangle + "\n}", "f"),
              single);
    EXPECT_EQ(parse_geojson("\x1E" + one, "f"), single);
    EXPECT_EQ(parse_geojson(one + "\n\n \n", "f"), single);
}

TEST(ToolsGeojson, RefusalsOfSequencesNameTheLine) {
    const std::string one = polygon(triangle);
    EXPECT_EQ(error_of(one + "\n\n {\"type\" 1}\n" + one).find("a.geojson:3:10: not JSON"), 0U)
        << error_of(one + "\n\n {\"type\" 1}\n" + one);
    EXPECT_EQ(error_of(one + "\n{\"type\": \"Circle\"}").find("a.geojson:2: type: "), 0U)
        << error_of(one + "\n{\"type\": \"Circle\"}");
    EXPECT_EQ(error_of(one + "\n" + one + one).find("a.geojson:2:"), 0U);
    const std::string longer = "\x1E{\n\"type\":\n\"Circle\"}\n\x1E\n\n";
    EXPECT_EQ(error_of(longer).find("a.geojson:1: type: "), 0U) << error_of(longer);
    EXPECT_EQ(error_of("\x1E" + one + "\n\x1E\n{\"type\": 1}").find("a.geojson:3: type: "), 0U)
        << error_of("\x1E" + one + "\n\x1E\n{\"type\": 1}");
    EXPECT_EQ(error_of("\x1E" + one + "\n\x1E{\n1}").find("a.geojson:3:1: "), 0U)
        << error_of("\x1E" + one + "\n\x1E{\n1}");
    const std::string point = R"({"type": "Point", "coordinates": [1, 2]})";
    EXPECT_NE(error_of(point + "\n" + point).find("Point (2)"), std::string::npos);
}

TEST(ToolsGeojson, PartsThatHoldNoAreaAreSkippedAndCounted) {
    const std::string point = R"({"type": "Point", "coordinates": [1, 2]})";
    const std::string line = R"({"type": "LineString", "coordinates": [[1, 2], [3, 4]]})";
    const std::string empty = R"({"type": "MultiPolygon", "coordinates": [[]]})";
    const auto feature = [](const std::string& geometry) {
        return R"({"type": "Feature", "geometry": )" + geometry + "}";
    };
    SkippedParts skipped;
    const std::vector<Ring> rings = parse_geojson(
        R"({"type": "FeatureCollection", "features": [)" + feature(point) + "," + feature("null") +
            "," + feature(polygon(triangle)) + "," + feature(line) + "," + feature("null") + "," +
            feature(R"({"type": "GeometryCollection", "geometries": [)" + point + "," + empty +
                    "]}") +
            "]}",
        "f", skipped);
    EXPECT_EQ(rings, (std::vector<Ring>{{{0, 0}, {4, 0}, {0, 3}, {0, 0}}}));
    EXPECT_EQ(skipped.text(),
              "Point (2), feature without geometry (2), LineString (1), empty part (1)");
    SkippedParts inner;
    EXPECT_EQ(parse_geojson(polygon("[[[0, 0], [4, 0], [0, 3]], []]"), "f", inner).size(), 1U);
    EXPECT_EQ(inner.text(), "empty part (1)");
}

TEST(ToolsGeojson, WithoutAPolygonTheDocumentIsRefused) {
    EXPECT_EQ(error_of(R"({"type": "GeometryCollection", "geometries": []})"),
              "a.geojson: holds no polygon, only empty part (1)");
    EXPECT_EQ(error_of(R"({"type": "FeatureCollection", "features": []})"),
              "a.geojson: holds no polygon");
    EXPECT_EQ(error_of(R"({"type": "Feature", "geometry": null})"),
              "a.geojson: holds no polygon, only feature without geometry (1)");
    EXPECT_EQ(error_of(R"({"type": "Feature"})"),
              "a.geojson: holds no polygon, only feature without geometry (1)");
    EXPECT_EQ(error_of(R"({"type": "LineString", "coordinates": [[0, 0], [1, 1]]})"),
              "a.geojson: holds no polygon, only LineString (1)");
    EXPECT_EQ(error_of(polygon("[]")), "a.geojson: holds no polygon, only empty part (1)");
}

TEST(ToolsGeojson, CollectionsNameWhatIsWrongInThem) {
    EXPECT_EQ(error_of(R"({"type": "GeometryCollection", "geometries": [{"type": "Circle"}]})"),
              "a.geojson: geometries[0].type: \"Circle\" is none of Polygon, MultiPolygon, "
              "GeometryCollection");
    std::string nested = polygon(triangle);
    for (int i = 0; i < 70; ++i) {
        nested = R"({"type": "GeometryCollection", "geometries": [)" + nested + "]}";
    }
    EXPECT_NE(error_of(nested).find("collections nested too deep"), std::string::npos);
}

TEST(ToolsGeojson, KeepsHolesOpenRingsAndEveryDigitAndDropsHeights) {
    const std::vector<Ring> rings = parse_geojson(
        polygon(
            "[[[1000000.123456789, -2e-3, 7], [1, 2, 7, 8], [3, 5]], [[0, 0], [1, 0], [0, 1]]]"),
        "f");
    const std::vector<Ring> expected{{{1000000.123456789, -2e-3}, {1, 2}, {3, 5}},
                                     {{0, 0}, {1, 0}, {0, 1}}};
    EXPECT_EQ(rings, expected);
}

TEST(ToolsGeojson, StructureErrorsNameTheFileAndThePlace) {
    EXPECT_EQ(error_of(polygon(R"([[[0, 0], [1, "x"], [0, 1]]])")),
              "a.geojson: coordinates[0][1][1]: not a number but a string");
    EXPECT_EQ(error_of(polygon("[[[0, 0], [1], [0, 1]]]")),
              "a.geojson: coordinates[0][1]: a position needs two numbers, not 1");
    EXPECT_EQ(error_of(polygon("[[[0, 0], 5, [0, 1]]]")),
              "a.geojson: coordinates[0][1]: not an array but a number");
    EXPECT_EQ(error_of(polygon("[[0, 0], [1, 0], [0, 1]]")),
              "a.geojson: coordinates[0][0]: not an array but a number");
    EXPECT_EQ(error_of(polygon("[[[[0, 0], [1, 0], [0, 1]]]]")),
              "a.geojson: coordinates[0][0][0]: not a number but an array");
    EXPECT_EQ(error_of(polygon("[[], [[0, 0], [1, 0], [0, 1]]]")),
              "a.geojson: coordinates[1]: an inner ring whose outer ring is empty");
    EXPECT_EQ(error_of(polygon("[[]]")), "a.geojson: holds no polygon, only empty part (1)");
    EXPECT_EQ(error_of(polygon("{}")), "a.geojson: coordinates: not an array but an object");
    EXPECT_EQ(error_of(R"({"type": "Polygon"})"), "a.geojson: has no \"coordinates\"");
    EXPECT_EQ(error_of(R"({"type": 3})"), "a.geojson: type: not a string but a number");
    EXPECT_EQ(error_of("[1, 2]"), "a.geojson: not an object but an array");
    EXPECT_EQ(error_of(R"({"type": "FeatureCollection", "features": [{"type": "Feature",
                           "geometry": {"type": "Polygon", "coordinates": [[[0, null]]]}}]})"),
              "a.geojson: features[0].geometry.coordinates[0][0][1]: not a number but null");
}

TEST(ToolsGeojson, SyntaxErrorsNameFileLineAndColumn) {
    EXPECT_EQ(error_of("{\n  \"type\": NaN}").substr(0, 25), "a.geojson:2:11: not JSON:");
    EXPECT_EQ(error_of("{\"type\":").substr(0, 24), "a.geojson:1:9: not JSON:");
    EXPECT_EQ(error_of("{\"type\": \"Polygon\",\n\"coordinates\": [[[0, 1e999]]]}").substr(0, 25),
              "a.geojson:2:26: not JSON:");
    EXPECT_NE(error_of(polygon(triangle) + "x").find("a.geojson:1:"), std::string::npos);
}

TEST(ToolsGeojson, AbsurdNestingIsAnErrorLikeAnyOther) {
    constexpr std::size_t depth = 2'000'000;
    const std::string nested = std::string(depth, '[') + std::string(depth, ']');
    EXPECT_EQ(error_of(polygon(nested)),
              "a.geojson: coordinates[0][0]: a position needs two numbers, not 1");
    EXPECT_NE(error_of(std::string(depth, '[')), "no error");
}

}  // namespace
}  // namespace nearfield::tools
