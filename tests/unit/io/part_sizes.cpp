#include <gtest/gtest.h>
#include <tools/io/outline.hpp>
#include <tools/io/simple_features.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

using Sizes = std::vector<std::uint32_t>;

TEST(ToolsPartSizes, OfWellKnownText) {
    const std::string text =
        "GEOMETRYCOLLECTION(MULTIPOLYGON(((0 0,4 0,4 4),(1 1,2 1,2 2),EMPTY),EMPTY,((5 5,6 5,6 "
        "6))),POINT(1 1),POLYGON((7 7,8 7,8 8)))";
    SkippedParts skipped;
    Sizes sizes{9};
    EXPECT_EQ(parse_wkt(text, "f", skipped, &sizes).size(), 4U);
    EXPECT_EQ(sizes, (Sizes{2, 1, 1}));
    EXPECT_EQ(parse_outline({"f", text}).part_sizes, (Sizes{2, 1, 1}));
}

TEST(ToolsPartSizes, OfGeojson) {
    SkippedParts skipped;
    Sizes sizes;
    const std::string ring = "[[0, 0], [1, 0], [1, 1]]";
    const std::string text =
        R"({"type": "FeatureCollection", "features": [
            {"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[)" +
        ring + "], [], [" + ring + ", " + ring + R"(]]}},
            {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [)" +
        ring + "]}}]}";
    EXPECT_EQ(parse_geojson(text, "f", skipped, &sizes).size(), 4U);
    EXPECT_EQ(sizes, (Sizes{1, 2, 1}));
}

TEST(ToolsPartSizes, OfWellKnownBinary) {
    // Three positions of 0: rings of a triangle would be longer.
    const std::string ring = "03000000" + std::string(3 * 2 * 16, '0');
    const std::string one =
        "0103000000"
        "01000000" +
        ring;
    const std::string two =
        "0103000000"
        "02000000" +
        ring + ring;
    const std::string none =
        "0103000000"
        "00000000";
    const std::string one_and_an_empty_hole =
        "0103000000"
        "02000000" +
        ring + "00000000";
    SkippedParts skipped;
    Sizes sizes;
    const std::string text =
        "0106000000"
        "04000000" +
        two + none + one_and_an_empty_hole + one;
    EXPECT_EQ(parse_hex_wkb(text, "f", skipped, &sizes).size(), 4U);
    EXPECT_EQ(sizes, (Sizes{2, 1, 1}));
    EXPECT_EQ(parse_outline({"f", text}).part_sizes, (Sizes{2, 1, 1}));
}

}  // namespace
}  // namespace nearfield::tools
