#include "cli_test.hpp"

#include <string>
#include <string_view>

namespace nearfield::test {
namespace {

/// Files as Windows writes them: text as UTF-16 with a byte order mark.
class Utf16 : public CliTest {
protected:
    /// Each character is below 128.
    static std::string as_utf16(std::string_view text, bool little) {
        std::string bytes = little ? "\xFF\xFE" : "\xFE\xFF";
        for (const char c : text) {
            bytes += little ? c : '\0';
            bytes += little ? '\0' : c;
        }
        return bytes;
    }

    [[nodiscard]] Json count_inside(const std::string& file) const {
        return answer(
            {"query", "penetration", a_, file, "-d", "0.1", "--technique", "cpu"})["count"];
    }
};

TEST_F(Utf16, OfEitherByteOrderIsRead) {
    const std::string wkt = "POLYGON ((0.5 0.5, 2 0.5, 2 2, 0.5 2, 0.5 0.5))\r\n";
    const std::string svg =
        "<?xml version=\"1.0\" encoding=\"UTF-16\"?>\n<svg "
        "xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0.5 -0.5H2V-2H0.5Z\"/></svg>";
    const Json expected = count_inside(folder_.write("plain.wkt", wkt));
    EXPECT_GT(expected, 0);
    for (const bool little : {true, false}) {
        EXPECT_EQ(count_inside(folder_.write("wide.wkt", as_utf16(wkt, little))), expected);
        EXPECT_EQ(count_inside(folder_.write("wide.txt", as_utf16(wkt, little))), expected);
        EXPECT_EQ(count_inside(folder_.write("wide.svg", as_utf16(svg, little))), expected);
    }
}

TEST_F(Utf16, ErrorsNameLineAndColumnOfTheText) {
    const std::string file = folder_.write("bad.wkt", as_utf16("POLYGON\n((0 0, x))", true));
    expect_refused({"query", "penetration", a_, file, "-d", "0.1"}, {file + ":2:8"});
}

TEST_F(Utf16, ThatEndsWithinACharacterIsRefused) {
    const std::string half = as_utf16("POLYGON", true) + "(";
    const std::string file = folder_.write("half.wkt", half);
    expect_refused({"query", "penetration", a_, file, "-d", "0.1"}, {file, "is not UTF-16"});
    const std::string empty = folder_.write("empty.wkt", "\xFF\xFE");
    expect_refused({"query", "penetration", a_, empty, "-d", "0.1"}, {empty, "is empty"});
}

}  // namespace
}  // namespace nearfield::test
