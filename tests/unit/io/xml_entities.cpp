#include "support.hpp"

#include <gtest/gtest.h>
#include <tools/io/svg.hpp>
#include <tools/io/svg_document.hpp>

#include <cstddef>
#include <string>

namespace nearfield::tools {
namespace {

std::string expanded(const std::string& text) {
    return ExpandedXml(text, "a.svg").take_text();
}

/// The number of contours of an SVG file.
std::size_t contours_of(const std::string& text) {
    SkippedParts skipped;
    return parse_svg(text, "a.svg", skipped).path.contours().size();
}

std::string with_entities(const std::string& content) {
    return "<svg xmlns='http://www.w3.org/2000/svg'>" + content + "</svg>";
}

TEST(ToolsXmlEntities, AreReplacedByTheirTexts) {
    const std::string type =
        "<!DOCTYPE svg [<!ENTITY a \"x]>y\"> <!ENTITY b '&a;&a;'>\n"
        "<!ENTITY far SYSTEM \"file\"><!ENTITY % p 'q'>]>";
    EXPECT_EQ(expanded(type + "<s t='&a;'>&b;</s>"), type + "<s t='x]>y'>x]>yx]>y</s>");
    const std::string stays = "<s>&#65;&amp;&far;&p;&none;&a<!-- &a; --><![CDATA[&a;]]></s>";
    EXPECT_EQ(expanded(type + stays), type + stays);
    const std::string without = "<!DOCTYPE svg PUBLIC 'x' 'y'><s>&a;</s>";
    EXPECT_EQ(expanded(without), without);
}

TEST(ToolsXmlEntities, KeepTheirPlacesInTheFile) {
    const std::string begin = "<!DOCTYPE s [<!ENTITY a \"long text\">]>";
    ExpandedXml xml(begin + "<s>&a;<t/>", "a.svg");
    const std::string text = xml.take_text();
    const std::size_t entity = text.rfind("long text");
    EXPECT_EQ(xml.offset_in_file(entity), begin.size() + 3);
    EXPECT_EQ(xml.offset_in_file(entity + 5), begin.size() + 3);
    EXPECT_EQ(xml.offset_in_file(text.find("<t/>")), begin.size() + 6);
    EXPECT_EQ(xml.offset_in_file(2), 2U);
}

TEST(ToolsXmlEntities, CirclesAndFloodsAreRefused) {
    EXPECT_EQ(input_error([] {
                  return expanded("<!DOCTYPE s [<!ENTITY a '&b;'><!ENTITY b '&a;'>]>\n<s>&a;</s>");
              }),
              "a.svg:2:4: entities refer to each other too often");
    std::string flood = "<!DOCTYPE s [<!ENTITY e0 '0123456789'>";
    for (int i = 1; i < 12; ++i) {
        const std::string before = "&e" + std::to_string(i - 1) + ";";
        std::string ten;
        for (int k = 0; k < 10; ++k) {
            ten += before;
        }
        flood += "<!ENTITY e" + std::to_string(i) + " '" + ten + "'>";
    }
    EXPECT_NE(input_error([&] { return expanded(flood + "]><s>&e11;</s>"); }).find("too often"),
              std::string::npos);
}

TEST(ToolsXmlEntities, MatterToDrawings) {
    const std::string rect = "<rect width='1' height='1'/>";
    const std::string type = "<!DOCTYPE svg [<!ENTITY hidden \"display:none\"><!ENTITY r \"" +
                             rect + "\"><!ENTITY s \".a{display:none}\">]>";
    EXPECT_EQ(contours_of(type + with_entities(rect + "<g style='&hidden;'>" + rect + "</g>&r;")),
              2U);
    EXPECT_EQ(contours_of(type + with_entities("<style>&s;</style><g class='b&#10;a'>" + rect +
                                               "</g>" + rect)),
              1U);
    EXPECT_EQ(contours_of(with_entities("<g style='display:&#110;one'>" + rect + "</g>" + rect)),
              1U);
    EXPECT_EQ(contours_of(with_entities("<path d='M0 0&#x20;h10&#10;v10h-10z'/>")), 1U);
    EXPECT_EQ(
        contours_of(with_entities("<rect id='a&#x62;' width='1' height='1'/><use href='#ab'/>")),
        2U);
    const std::string broken = type + "\n" + with_entities("&r;<rect width='x'/>");
    SkippedParts skipped;
    EXPECT_EQ(input_error([&] { return parse_svg(broken, "a.svg", skipped); }),
              "a.svg:2:57: expected a number");
}

TEST(ToolsSvgNamespaces, DecideWhatIsDrawn) {
    const std::string rect = "<rect width='1' height='1'/>";
    const std::string space = "http://www.w3.org/2000/svg";
    EXPECT_EQ(contours_of("<svg>" + rect + "</svg>"), 1U);
    EXPECT_EQ(contours_of("<svg:svg><svg:rect width='1' height='1'/></svg:svg>"), 1U);
    EXPECT_EQ(contours_of("<svg xmlns='" + space + "' xmlns:s='" + space + "'>" + rect +
                          "<s:rect width='1' height='1'/></svg>"),
              2U);
    EXPECT_EQ(contours_of("<n:svg xmlns:n='" + space + "'><n:rect width='1' height='1'/></n:svg>"),
              1U);
    EXPECT_EQ(
        contours_of(with_entities(rect + "<g xmlns='http://other.example/'>" + rect + "</g>")), 1U);
    EXPECT_EQ(contours_of(with_entities(rect + "<x:y xmlns:x='z'>" + rect + "</x:y>")), 1U);
    SkippedParts skipped;
    EXPECT_EQ(input_error([&] {
                  return parse_svg("<svg xmlns='http://other.example/'/>", "a.svg", skipped);
              }),
              "a.svg:1:2: the outermost element, svg, is not in the namespace of SVG");
}

TEST(ToolsSvgLanguages, OtherThanEnglishAreNotDrawn) {
    const auto rect = [](const std::string& attribute) {
        return "<rect width='1' height='1' " + attribute + "/>";
    };
    EXPECT_EQ(contours_of(with_entities(rect("systemLanguage='xx'") + rect(""))), 1U);
    EXPECT_EQ(contours_of(with_entities(rect("systemLanguage='de, en-GB'") +
                                        rect("requiredExtensions='x'"))),
              1U);
    EXPECT_EQ(contours_of(with_entities("<switch>" + rect("systemLanguage='enx'") + rect("") +
                                        rect("") + "</switch>")),
              1U);
}

}  // namespace
}  // namespace nearfield::tools
