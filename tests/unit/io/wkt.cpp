#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/folder.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/wkt.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

std::string error_of(const std::string& text) {
    return input_error([&] { return parse_wkt(text, "a.wkt"); });
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
             "MULTIPOLYGON(((0 0,4 -0.5,1e-3 3)))",
         }) {
        EXPECT_EQ(parse_wkt(text, "f"), triangle) << text;
    }
}

TEST(ToolsWkt, KeepsEveryRingInOrder) {
    const std::vector<Ring> expected{
        {{0, 0}, {9, 0}, {0, 9}}, {{1, 1}, {2, 1}, {1, 2}}, {{5, 5}, {6, 5}, {5, 6}}};
    EXPECT_EQ(parse_wkt("MULTIPOLYGON(((0 0,9 0,0 9),(1 1,2 1,1 2)),((5 5,6 5,5 6)))", "f"),
              expected);
}

TEST(ToolsWkt, ErrorsNameFileLineAndColumn) {
    EXPECT_EQ(error_of("POINT(1 2)"), "a.wkt:1:1: \"POINT\" is neither POLYGON nor MULTIPOLYGON");
    EXPECT_EQ(error_of("((0 0))"), "a.wkt:1:1: expected POLYGON or MULTIPOLYGON");
    EXPECT_EQ(error_of("POLYGON EMPTY"), "a.wkt:1:9: an empty geometry");
    EXPECT_EQ(error_of("POLYGON(EMPTY)"), "a.wkt:1:9: an empty geometry");
    EXPECT_EQ(error_of("POLYGON((0 0,\n1 x,0 1))"), "a.wkt:2:3: expected a number");
    EXPECT_EQ(error_of("POLYGON((0 0,\n1 1e,0 1))"), "a.wkt:2:3: expected a number");
    EXPECT_EQ(error_of("POLYGON((0 0,1,0 1))"),
              "a.wkt:1:14: a position needs 2 numbers here, not 1");
    EXPECT_EQ(error_of("POLYGON Z((0 0 1,1 2,0 1 1))"),
              "a.wkt:1:18: a position needs 3 numbers here, not 2");
    EXPECT_EQ(error_of("POLYGON M((0 0 1 2))"),
              "a.wkt:1:18: a position has at most 3 numbers here");
    EXPECT_EQ(error_of("POLYGON((0 0,1 nan,0 1))"), "a.wkt:1:16: not a finite number");
    EXPECT_EQ(error_of("POLYGON((0 0,1 -inf,0 1))"), "a.wkt:1:16: not a finite number");
    EXPECT_EQ(error_of("POLYGON((0 0,1 1e999,0 1))"),
              "a.wkt:1:16: a number too large or too small for double precision");
    EXPECT_EQ(error_of("POLYGON((0 0,1 1,0 1)"), "a.wkt:1:22: the text ends where ')' is expected");
    EXPECT_EQ(error_of("POLYGON((0 0,1 1,"), "a.wkt:1:18: the text ends too early");
    EXPECT_EQ(error_of("POLYGON(0 0,1 1,0 1)"), "a.wkt:1:9: expected '('");
    EXPECT_EQ(error_of("POLYGON((0 0,1 1,0 1)))"),
              "a.wkt:1:23: text after the end of the geometry");
    EXPECT_EQ(error_of("POLYGON Q((0 0,1 1,0 1))"), "a.wkt:1:9: \"Q\" is none of Z, M, ZM");
    EXPECT_EQ(error_of("SRID 4;POLYGON((0 0,1 1,0 1))"),
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
    EXPECT_EQ(error(other),
              other + ":1:1: neither GeoJSON, well-known text, SVG nor SVG path data");
}

}  // namespace
}  // namespace nearfield::tools
