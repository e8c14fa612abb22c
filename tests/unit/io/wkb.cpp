#include "support.hpp"

#include <gtest/gtest.h>
#include <tests/support/folder.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/simple_features.hpp>

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace nearfield::tools {
namespace {

/// Writes well-known binary.
class Bytes {
public:
    explicit Bytes(bool little_endian = true) : little_endian_(little_endian) {}

    Bytes& header(std::uint32_t type) {
        text_.push_back(little_endian_ ? '\1' : '\0');
        return count(type);
    }
    Bytes& count(std::uint32_t number) { return write(number, sizeof number); }
    Bytes& numbers(std::initializer_list<double> values) {
        for (const double value : values) {
            write(std::bit_cast<std::uint64_t>(value), sizeof value);
        }
        return *this;
    }
    Bytes& append(const Bytes& other) {
        text_ += other.text_;
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    Bytes& write(std::uint64_t value, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t place = little_endian_ ? i : size - 1 - i;
            text_.push_back(static_cast<char>(value >> (8 * place) & 0xFFU));
        }
        return *this;
    }

    bool little_endian_;
    std::string text_;
};

const std::vector<Ring> wkb_triangle{{{0, 0}, {4, -0.5}, {1e-3, 3}}};

Bytes triangle_bytes(bool little_endian = true) {
    return Bytes(little_endian).header(3).count(1).count(3).numbers({0, 0, 4, -0.5, 1e-3, 3});
}

std::vector<Ring> rings_of(const Bytes& bytes) {
    SkippedParts skipped;
    std::vector<Ring> rings = parse_wkb(bytes.text(), "f", skipped);
    EXPECT_TRUE(skipped.empty()) << skipped.text();
    return rings;
}

std::string error_of_bytes(const std::string& bytes) {
    SkippedParts skipped;
    return input_error([&] { return parse_wkb(bytes, "a.wkb", skipped); });
}

std::string hex_error_of(const std::string& text) {
    SkippedParts skipped;
    return input_error([&] { return parse_hex_wkb(text, "a.wkb", skipped); });
}

TEST(ToolsWkb, ReadsBothByteOrdersAndEveryKindOfDimension) {
    for (const bool little_endian : {true, false}) {
        EXPECT_EQ(rings_of(triangle_bytes(little_endian)), wkb_triangle);
        for (const std::uint32_t type : {1003U, 2003U, 0x80000003U, 0x40000003U}) {
            EXPECT_EQ(rings_of(Bytes(little_endian)
                                   .header(type)
                                   .count(1)
                                   .count(3)
                                   .numbers({0, 0, 9, 4, -0.5, 9, 1e-3, 3, 9})),
                      wkb_triangle)
                << type;
        }
        for (const std::uint32_t type : {3003U, 0xC0000003U}) {
            EXPECT_EQ(rings_of(Bytes(little_endian)
                                   .header(type)
                                   .count(1)
                                   .count(3)
                                   .numbers({0, 0, 9, 8, 4, -0.5, 9, 8, 1e-3, 3, 9, 8})),
                      wkb_triangle)
                << type;
        }
        EXPECT_EQ(rings_of(Bytes(little_endian)
                               .header(0x20000003U)
                               .count(4326)
                               .count(1)
                               .count(3)
                               .numbers({0, 0, 4, -0.5, 1e-3, 3})),
                  wkb_triangle);
    }
}

TEST(ToolsWkb, CollectionsMayMixByteOrdersAndWhatHoldsNoAreaIsCounted) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const Bytes parts = Bytes(false).header(7).count(6);
    Bytes all = parts;
    all.append(Bytes(true).header(6).count(2))
        .append(triangle_bytes(false))
        .append(Bytes(true).header(3).count(0));
    all.append(Bytes(false).header(1).numbers({none, none}));
    all.append(Bytes(true).header(1002).count(2).numbers({0, 0, 0, 1, 1, 1}));
    all.append(Bytes(true).header(4).count(1)).append(Bytes(false).header(1).numbers({1, 2}));
    all.append(Bytes(true).header(5).count(1)).append(Bytes(false).header(2).count(0));
    all.append(Bytes(true).header(7).count(1)).append(triangle_bytes());
    SkippedParts skipped;
    EXPECT_EQ(parse_wkb(all.text(), "f", skipped),
              (std::vector<Ring>{wkb_triangle[0], wkb_triangle[0]}));
    EXPECT_EQ(skipped.text(),
              "empty part (1), Point (1), LineString (1), MultiPoint (1), MultiLineString (1)");
}

TEST(ToolsWkb, GeometriesThatFollowEachOtherAreTheParts) {
    SkippedParts skipped;
    const std::string both = triangle_bytes(true).text() + triangle_bytes(false).text();
    EXPECT_EQ(parse_wkb(both, "f", skipped), (std::vector<Ring>{wkb_triangle[0], wkb_triangle[0]}));
}

TEST(ToolsWkb, ErrorsNameFileAndByte) {
    const std::string good = triangle_bytes().text();
    for (std::size_t size = 0; size < good.size(); ++size) {
        const std::string error = error_of_bytes(good.substr(0, size));
        EXPECT_EQ(error.rfind("a.wkb: byte ", 0), 0U) << size << ": " << error;
    }
    EXPECT_EQ(error_of_bytes(good + "xy"), "a.wkb: byte 61: 2 bytes after the end of the geometry");
    EXPECT_EQ(error_of_bytes("\2" + good.substr(1)),
              "a.wkb: byte 0: a byte order is 0 or 1, not 2");
    EXPECT_EQ(error_of_bytes(good.substr(0, 40)),
              "a.wkb: byte 9: announces 3 positions, more than the rest of the file has room for");
    EXPECT_EQ(error_of_bytes(good.substr(0, 3)),
              "a.wkb: byte 0: the file ends within the byte order and type of a geometry");
    EXPECT_EQ(error_of_bytes(Bytes().header(3).count(UINT32_MAX).text()),
              "a.wkb: byte 5: announces 4294967295 rings, more than the rest of the file has room "
              "for");
    EXPECT_EQ(error_of_bytes(Bytes().header(10).count(0).text()),
              "a.wkb: byte 1: CurvePolygon is not read, only Polygon, MultiPolygon and "
              "GeometryCollection");
    EXPECT_EQ(error_of_bytes(Bytes().header(4003).count(0).text()),
              "a.wkb: byte 1: there is no type of geometry 4003");
    EXPECT_EQ(error_of_bytes(Bytes().header(99).count(0).text()),
              "a.wkb: byte 1: there is no type of geometry 99");
    EXPECT_EQ(error_of_bytes(Bytes().header(6).count(1).header(1).numbers({0, 0}).text()),
              "a.wkb: byte 10: a MultiPolygon holds Polygons, not a Point");
    EXPECT_EQ(error_of_bytes(Bytes().header(4).count(1).header(2).count(0).text()),
              "a.wkb: byte 10: a MultiPoint holds a LineString");
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_of_bytes(
                  Bytes().header(3).count(1).count(3).numbers({0, 0, 4, infinite, 1e-3, 3}).text()),
              "a.wkb: byte 37: not a finite number");
    EXPECT_EQ(error_of_bytes(Bytes().header(1).numbers({1, 2}).text()),
              "a.wkb: byte 0: holds no polygon, only Point (1)");
    EXPECT_EQ(error_of_bytes(Bytes().header(3).count(1).count(0).text()),
              "a.wkb: byte 0: holds no polygon, only empty part (1)");
    EXPECT_EQ(error_of_bytes(
                  Bytes().header(3).count(2).count(0).count(3).numbers({0, 0, 4, 0, 0, 3}).text()),
              "a.wkb: byte 13: an inner ring whose outer ring is empty");
    std::string nested;
    for (int i = 0; i < 70; ++i) {
        nested += Bytes().header(7).count(1).text();
    }
    EXPECT_EQ(error_of_bytes(nested + good), "a.wkb: byte 576: collections nested too deep");
}

TEST(ToolsWkb, ReadsHexadecimalDigits) {
    // As PostGIS prints POLYGON((0 0,4 0,0 3,0 0)) with SRID 4326.
    const std::string hex =
        "0103000020E61000000100000004000000000000000000000000000000000000000000000000001040"
        "00000000000000000000000000000000000000000000084000000000000000000000000000000000\n";
    const std::vector<Ring> closed{{{0, 0}, {4, 0}, {0, 3}, {0, 0}}};
    SkippedParts skipped;
    EXPECT_EQ(parse_hex_wkb(hex, "f", skipped), closed);
    std::string lower = hex;
    for (char& c : lower) {
        c = c == 'E' ? 'e' : c;
    }
    EXPECT_EQ(parse_hex_wkb(lower, "f", skipped), closed);
    EXPECT_EQ(parse_hex_wkb("\\x" + hex, "f", skipped), closed);
    EXPECT_EQ(parse_hex_wkb(" 0x" + hex + "\\x" + lower, "f", skipped).size(), 2U);
    EXPECT_EQ(format_of({"a.wkb", "\\x" + hex}), OutlineFormat::hex_wkb);
    EXPECT_EQ(format_of({"a.wkt", "0x" + hex}), OutlineFormat::hex_wkb);
    EXPECT_EQ(hex_error_of("0103\n00x0"), "a.wkb:2:3: expected a hexadecimal digit of WKB");
    EXPECT_EQ(hex_error_of("010"), "a.wkb:1:4: an odd number of hexadecimal digits");
    EXPECT_EQ(hex_error_of("0203000000"), "a.wkb: byte 0: a byte order is 0 or 1, not 2");
}

TEST(ToolsOutline, WkbIsKnownByExtensionAndContent) {
    const test_support::Folder folder;
    const std::string hex =
        "000000000300000001000000030000000000000000000000000000000040100000000000000000000000000000"
        "00000000000000004008000000000000";
    const std::vector<Ring> plain{{{0, 0}, {4, 0}, {0, 3}}};
    for (const bool little_endian : {true, false}) {
        const std::string binary = triangle_bytes(little_endian).text();
        for (const char* const name : {"a.wkb", "A.WKB", "a.bin", "a"}) {
            EXPECT_EQ(read_outline(folder.write(name, binary)).rings, wkb_triangle) << name;
        }
    }
    for (const char* const name : {"a.wkb", "a.wkt", "a.txt", "a"}) {
        EXPECT_EQ(read_outline(folder.write(name, "\n" + hex + "\n")).rings, plain) << name;
    }
    const std::string other = folder.write("other.wkb", "POLYGON((0 0,1 0,0 1))");
    EXPECT_EQ(input_error([&] { return read_outline(other); }),
              other + ": byte 0: a byte order is 0 or 1, not 80");
}

}  // namespace
}  // namespace nearfield::tools
