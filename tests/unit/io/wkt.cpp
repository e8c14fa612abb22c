#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/folder.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/simple_features.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

std::string error_of_wkt(const std::string& text) {
    SkippedParts skipped;
    return input_error([&] { return parse_wkt(text, "a.wkt", skipped); });
}

/// The rings of a text that holds polygons alone.
std::vector<Ring> rings_of(const std::string& text) {
    SkippedParts skipped;
    std::vector<Ring> rings = parse_wkt(text, "f", skipped);
    EXPECT_TRUE(skipped.empty()) << skipped.text();
    return rings;
}

/// What is skipped of a text whose only ring is a triangle.
std::string skipped_of(const std::string& text) {
    SkippedParts skipped;
    EXPECT_EQ(parse_wkt(text, "f", skipped), (std::vector<Ring>{{{0, 0}, {4, 0}, {0, 3}}})) << text;
    return skipped.text();
}

TEST(ToolsWkt, ReadsPolygonsInEverySpelling) {
    const std::vector<Ring> triangle{{{0, 0}, {4, -0.5}, {1e-3, 3}}};
    for (const char* const text : {
             "POLYGON((0 0,4 -.5,1e-3 3))",
             "polygon\n ( ( 0   0 , +4 -5E-1 , 0.001\t3 ) )\r\n",
             "SRID=4326;POLYGON((0 0,4 -0.5,1e-3 3))",
             "POLYGON Z ((0 0 9,4 -0.5 9,1e-3 3 9))",
             "PolygonM((0 0 9,4 -0.5 9,1e-3 3 9))",
             "POLYGON ZM ((0 0 9 8,4 -0.5 9 8,1e-3 3 9 8))",
             "POLYGON((0 0 9,4 -0.5 9,1e-3 3 9))",
             "POLYGON Z((0 0 nan,4 -0.5 NaN,1e-3 3 inf))",
             "MULTIPOLYGON(((0 0,4 -0.5,1e-3 3)))",
             "POLYGON((0 0,4 -.5,1e-3 3));",
             "SRID=4326;POLYGON((0 0,4 -0.5,1e-3 3)) ;\n",
             "GeometryCollection Z (Polygon((0 0 9,4 -.5 9,1e-3 3 9)))",
             "GEOMETRYCOLLECTIONM(GEOMETRYCOLLECTION(POLYGON M((0 0 9,4 -.5 9,1e-3 3 9))))",
         }) {
        EXPECT_EQ(rings_of(text), triangle) << text;
    }
}

TEST(ToolsWkt, KeepsEveryRingInOrder) {
    const std::vector<Ring> expected{
        {{0, 0}, {9, 0}, {0, 9}}, {{1, 1}, {2, 1}, {1, 2}}, {{5, 5}, {6, 5}, {5, 6}}};
    EXPECT_EQ(rings_of("MULTIPOLYGON(((0 0,9 0,0 9),(1 1,2 1,1 2)),((5 5,6 5,5 6)))"), expected);
    EXPECT_EQ(rings_of("GEOMETRYCOLLECTION(POLYGON((0 0,9 0,0 9),(1 1,2 1,1 2)),"
                       "GEOMETRYCOLLECTION(MULTIPOLYGON(((5 5,6 5,5 6)))))"),
              expected);
}

TEST(ToolsWkt, PartsThatHoldNoAreaAreSkippedAndCounted) {
    const std::string polygon = "POLYGON((0 0,4 0,0 3))";
    EXPECT_EQ(skipped_of("MULTIPOLYGON(EMPTY,((0 0,4 0,0 3)),EMPTY)"), "empty part (2)");
    EXPECT_EQ(skipped_of("POLYGON((0 0,4 0,0 3),EMPTY)"), "empty part (1)");
    EXPECT_EQ(skipped_of("GEOMETRYCOLLECTION(POLYGON EMPTY," + polygon + ",POLYGON Z EMPTY)"),
              "empty part (2)");
    EXPECT_EQ(skipped_of("GEOMETRYCOLLECTION(GEOMETRYCOLLECTION EMPTY," + polygon + ")"),
              "empty part (1)");
    EXPECT_EQ(
        skipped_of("GEOMETRYCOLLECTION(POINT(1 2),LINESTRING(1 2,3 4),POINT Z(1 2 3)," + polygon +
                   ",POINT EMPTY,MULTIPOINT(1 2,3 4),MULTIPOINT((1 2),EMPTY),"
                   "MULTILINESTRING((0 0,1 1),(2 2,3 3)))"),
        "POINT (3), LINESTRING (1), MULTIPOINT (2), MULTILINESTRING (1)");
    // A dimension ends with its geometry.
    EXPECT_EQ(error_of_wkt("GEOMETRYCOLLECTION(POINT Z(1 2 3)," + polygon + ",POINT Z(1 2))"),
              "a.wkt:1:66: a position needs 3 numbers here, not 2");
}

TEST(ToolsWkt, WithoutAPolygonTheTextIsRefused) {
    EXPECT_EQ(error_of_wkt("POINT(1 2)"), "a.wkt:1:1: holds no polygon, only POINT (1)");
    EXPECT_EQ(error_of_wkt("\nPOLYGON EMPTY"), "a.wkt:2:1: holds no polygon, only empty part (1)");
    EXPECT_EQ(error_of_wkt("POLYGON(EMPTY)"), "a.wkt:1:1: holds no polygon, only empty part (1)");
    EXPECT_EQ(error_of_wkt("GEOMETRYCOLLECTION(LINESTRING(0 0,1 1),MULTIPOLYGON EMPTY)"),
              "a.wkt:1:1: holds no polygon, only LINESTRING (1), empty part (1)");
    EXPECT_EQ(error_of_wkt("POLYGON(EMPTY,(0 0,4 0,0 3))"),
              "a.wkt:1:15: an inner ring whose outer ring is EMPTY");
    std::string nested = "POLYGON((0 0,4 0,0 3))";
    for (int i = 0; i < 70; ++i) {
        nested = "GEOMETRYCOLLECTION(" + nested + ")";
    }
    EXPECT_EQ(error_of_wkt(nested), "a.wkt:1:1217: collections nested too deep");
}

TEST(ToolsWkt, GeometriesThatFollowEachOtherAreTheParts) {
    EXPECT_EQ(rings_of("POLYGON((0 0,4 0,0 3))\nSRID=3;POLYGON Z((5 5 1,6 5 1,6 6 1));\n"),
              rings_of("MULTIPOLYGON(((0 0,4 0,0 3)),((5 5,6 5,6 6)))"));
    EXPECT_EQ(skipped_of("POINT(1 2);\nPOLYGON((0 0,4 0,0 3))"), "POINT (1)");
    EXPECT_EQ(error_of_wkt("POLYGON EMPTY\nPOINT(1 2)"),
              "a.wkt:1:1: holds no polygon, only empty part (1), POINT (1)");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,4 0,0 3))\nPOLIGON((0 0,4 0,0 3))"),
              "a.wkt:2:1: \"POLIGON\" is none of POLYGON, MULTIPOLYGON, GEOMETRYCOLLECTION");
}

TEST(ToolsWkt, ErrorsNameFileLineAndColumn) {
    EXPECT_EQ(error_of_wkt("CURVEPOLYGON((0 0,1 1))"),
              "a.wkt:1:1: \"CURVEPOLYGON\" is none of POLYGON, MULTIPOLYGON, GEOMETRYCOLLECTION");
    EXPECT_EQ(error_of_wkt("((0 0))"),
              "a.wkt:1:1: expected POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1 1,0 1));;"),
              "a.wkt:1:24: text after the end of the geometry");
    EXPECT_EQ(error_of_wkt("GEOMETRYCOLLECTION(POINT(1 2 x))"), "a.wkt:1:30: expected a number");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,\n1 x,0 1))"), "a.wkt:2:3: expected a number");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,\n1 1e,0 1))"), "a.wkt:2:3: expected a number");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1,0 1))"),
              "a.wkt:1:14: a position needs 2 numbers here, not 1");
    EXPECT_EQ(error_of_wkt("POLYGON Z((0 0 1,1 2,0 1 1))"),
              "a.wkt:1:18: a position needs 3 numbers here, not 2");
    EXPECT_EQ(error_of_wkt("POLYGON M((0 0 1 2))"),
              "a.wkt:1:18: a position has at most 3 numbers here");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1 nan,0 1))"), "a.wkt:1:16: not a finite number");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1 -inf,0 1))"), "a.wkt:1:16: not a finite number");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1 1e999,0 1))"),
              "a.wkt:1:16: a number too large or too small for double precision");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1 1,0 1)"),
              "a.wkt:1:22: the text ends where ')' is expected");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1 1,"), "a.wkt:1:18: the text ends too early");
    EXPECT_EQ(error_of_wkt("POLYGON(0 0,1 1,0 1)"), "a.wkt:1:9: expected '('");
    EXPECT_EQ(error_of_wkt("POLYGON((0 0,1 1,0 1)))"),
              "a.wkt:1:23: text after the end of the geometry");
    EXPECT_EQ(error_of_wkt("POLYGON Q((0 0,1 1,0 1))"), "a.wkt:1:9: \"Q\" is none of Z, M, ZM");
    EXPECT_EQ(error_of_wkt("SRID 4;POLYGON((0 0,1 1,0 1))"),
              "a.wkt:1:1: expected SRID=...; before the geometry");
}

TEST(ToolsOutline, ExtensionAndContentSayWhatAFileIs) {
    const test_support::Folder folder;
    const std::string json = R"({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [0, 3]]]})";
    const std::string wkt = "POLYGON((0 0, 4 0, 0 3))";
    const std::vector<Ring> triangle{{{0, 0}, {4, 0}, {0, 3}}};
    const std::string mark = "\xEF\xBB\xBF";
    EXPECT_EQ(read_outline(folder.write("a.GeoJSON", mark + json)).rings, triangle);
    EXPECT_EQ(read_outline(folder.write("a.wkt", mark + wkt)).rings, triangle);
    EXPECT_EQ(read_outline(folder.write("json.txt", " \n" + json)).rings, triangle);
    EXPECT_EQ(read_outline(folder.write("wkt", wkt)).rings, triangle);
}

TEST(ToolsOutline, FilesThatCannotBeReadAreNamed) {
    const test_support::Folder folder;
    const auto error = [](const std::string& path) {
        return input_error([&] { return read_outline(path); });
    };
    const std::string missing = folder.path("missing.wkt");
    EXPECT_EQ(error(missing), missing + ": cannot be opened: No such file or directory");
    EXPECT_EQ(error(folder.path("")), folder.path("") + ": is a folder, not a file");
    const std::string empty = folder.write("empty.geojson", " \n");
    EXPECT_EQ(error(empty), empty + ": is empty");
    const std::string binary = folder.write("binary", std::string("PK\x03\x04\0\x01", 6));
    EXPECT_EQ(error(binary), binary + ": is not text: a zero byte at offset 4");
    const std::string other = folder.write("other", "\x89PNG");
    EXPECT_EQ(
        error(other),
        other + ":1:1: neither GeoJSON, well-known text or binary, SVG, SVG path data nor DXF");
}

}  // namespace
}  // namespace nearfield::tools
