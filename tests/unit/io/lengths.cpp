#include <gtest/gtest.h>
#include <tools/io/svg_values.hpp>
#include <tools/io/values.hpp>

#include <string>

namespace nearfield::tools {
namespace {

double pixels_of(const std::string& text) {
    const std::string file = "a.svg";
    return parse_length(SvgText(text, 0, text, file), SvgAxis::x, SvgViewport{200.0, 100.0});
}

TEST(ToolsLengths, OfAnInchAreTheSameInEveryUnit) {
    for (const char* const inch :
         {"1in", "96", "96px", "72pt", "6pc", "25.4mm", "2.54cm", "101.6Q", "48%", " 1e0in "}) {
        EXPECT_NEAR(pixels_of(inch), 96.0, 1e-12) << inch;
    }
}

TEST(ToolsLengths, HaveUnitsThatAreFoundByName) {
    const double inch = pixels_per(LengthUnit::inch);
    EXPECT_EQ(inch, 96.0);
    EXPECT_NEAR(25.4 * pixels_per(parse_name<LengthUnit>("mm", "--unit")), inch, 1e-12);
    EXPECT_NEAR(2.54 * pixels_per(parse_name<LengthUnit>("cm", "--unit")), inch, 1e-12);
    EXPECT_NEAR(72.0 * pixels_per(parse_name<LengthUnit>("pt", "--unit")), inch, 1e-12);
    EXPECT_NEAR(6.0 * pixels_per(parse_name<LengthUnit>("pc", "--unit")), inch, 1e-12);
    EXPECT_EQ(pixels_per(parse_name<LengthUnit>("px", "--unit")), 1.0);
    EXPECT_EQ(pixels_per(parse_name<LengthUnit>("user", "--unit")), 1.0);
}

}  // namespace
}  // namespace nearfield::tools
