#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>
#include <tools/io/wkb.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace nearfield::tools {
namespace {

/// The codes of the types that are read or skipped.
enum Type : std::uint32_t {
    point = 1,
    line_string = 2,
    polygon = 3,
    multi_point = 4,
    multi_line_string = 5,
    multi_polygon = 6,
    geometry_collection = 7,
};

constexpr std::array<const char*, 18> type_names{"Geometry",
                                                 "Point",
                                                 "LineString",
                                                 "Polygon",
                                                 "MultiPoint",
                                                 "MultiLineString",
                                                 "MultiPolygon",
                                                 "GeometryCollection",
                                                 "CircularString",
                                                 "CompoundCurve",
                                                 "CurvePolygon",
                                                 "MultiCurve",
                                                 "MultiSurface",
                                                 "Curve",
                                                 "Surface",
                                                 "PolyhedralSurface",
                                                 "TIN",
                                                 "Triangle"};

/// What stands before every geometry.
struct Header {
    std::size_t start = 0;
    std::uint32_t type = 0;
    std::size_t ordinates = 2;  ///< of a position
    bool little_endian = true;

    [[nodiscard]] std::size_t position_size() const { return ordinates * sizeof(double); }
};

class WkbParser {
public:
    WkbParser(std::string_view bytes, const std::string& file, SkippedParts& skipped)
        : bytes_(bytes), file_(file), skipped_(skipped) {}

    /// One geometry, or several, one after the other.
    std::vector<Ring> parse() {
        do {
            parse_geometry(read_header(), 0);
        } while (position_ < bytes_.size() && (bytes_[position_] == 0 || bytes_[position_] == 1));
        if (position_ < bytes_.size()) {
            fail(position_, std::to_string(bytes_.size() - position_) +
                                " bytes after the end of the geometry");
        }
        if (rings_.empty()) {
            fail(0, skipped_.no_polygon_text());
        }
        return std::move(rings_);
    }

    /// The number of rings of each polygon.
    [[nodiscard]] const std::vector<std::uint32_t>& part_sizes() const { return part_sizes_; }

private:
    [[noreturn]] void fail(std::size_t byte, const std::string& reason) const {
        throw InputError(file_ + ": byte " + std::to_string(byte) + ": " + reason);
    }

    /// Refuses a file that ends within the next `size` bytes.
    void require(std::size_t size, const char* what) const {
        if (bytes_.size() - position_ < size) {
            fail(position_, std::string("the file ends within ") + what);
        }
    }

    template <class Number>
    Number number(bool little_endian) {
        Number value = 0;
        for (std::size_t i = 0; i < sizeof(Number); ++i) {
            const auto byte = static_cast<unsigned char>(bytes_[position_ + i]);
            const std::size_t place = little_endian ? i : sizeof(Number) - 1 - i;
            value |= static_cast<Number>(byte) << (8 * place);
        }
        position_ += sizeof(Number);
        return value;
    }

    Header read_header() {
        require(5, "the byte order and type of a geometry");
        Header header{.start = position_};
        const auto order = static_cast<unsigned char>(bytes_[position_++]);
        if (order > 1) {
            fail(header.start, "a byte order is 0 or 1, not " + std::to_string(order));
        }
        header.little_endian = order == 1;
        read_type(number<std::uint32_t>(header.little_endian), header);
        return header;
    }

    /// A type with its dimensions: thousands by ISO, high bits by EWKB.
    void read_type(std::uint32_t code, Header& header) {
        constexpr std::uint32_t has_z = 1U << 31U;
        constexpr std::uint32_t has_m = 1U << 30U;
        constexpr std::uint32_t has_reference_system = 1U << 29U;
        const std::uint32_t plain = code & ~(has_z | has_m | has_reference_system);
        const std::uint32_t iso_dimensions = plain / 1000;  // none, Z, M, ZM
        header.type = plain % 1000;
        if (iso_dimensions > 3 || header.type >= type_names.size()) {
            fail(header.start + 1, "there is no type of geometry " + std::to_string(code));
        }
        if (header.type < point || header.type > geometry_collection) {
            fail(header.start + 1,
                 std::string(type_names[header.type]) +
                     " is not read, only Polygon, MultiPolygon and GeometryCollection");
        }
        const bool z = (code & has_z) != 0 || iso_dimensions % 2 == 1;
        const bool m = (code & has_m) != 0 || iso_dimensions >= 2;
        header.ordinates = 2U + (z ? 1U : 0U) + (m ? 1U : 0U);
        if ((code & has_reference_system) != 0) {
            require(sizeof(std::uint32_t), "the SRID of a geometry");
            position_ += sizeof(std::uint32_t);
        }
    }

    /// A number of things of at least `least_size` bytes each, which the file has room for.
    std::size_t read_count(const Header& header, std::size_t least_size, const char* what) {
        const std::size_t start = position_;
        require(sizeof(std::uint32_t), "a count");
        const std::size_t count = number<std::uint32_t>(header.little_endian);
        if (count > (bytes_.size() - position_) / least_size) {
            fail(start, "announces " + std::to_string(count) + " " + what +
                            ", more than the rest of the file has room for");
        }
        return count;
    }

    void parse_geometry(const Header& header, int depth) {
        switch (header.type) {
            case polygon:
                parse_polygon(header);
                break;
            case multi_polygon:
            case geometry_collection:
                parse_members(header, depth);
                break;
            default:
                skipped_.add(type_names[header.type]);
                skip_geometry(header);
                break;
        }
    }

    void parse_members(const Header& header, int depth) {
        if (depth == deepest_collection) {
            fail(header.start, "collections nested too deep");
        }
        const std::size_t count = read_count(header, 5, "geometries");
        if (count == 0) {
            skipped_.add(empty_part);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Header member = read_header();
            if (header.type == multi_polygon && member.type != polygon) {
                fail(member.start + 1, std::string("a MultiPolygon holds Polygons, not a ") +
                                           type_names[member.type]);
            }
            parse_geometry(member, depth + 1);
        }
    }

    void parse_polygon(const Header& header) {
        const std::size_t first = rings_.size();
        const std::size_t count = read_count(header, sizeof(std::uint32_t), "rings");
        if (count == 0) {
            skipped_.add(empty_part);
        }
        bool has_outer_ring = true;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t start = position_;
            Ring ring = read_ring(header);
            if (ring.empty()) {
                skipped_.add(empty_part);
                has_outer_ring = has_outer_ring && i > 0;
            } else if (!has_outer_ring) {
                fail(start, "an inner ring whose outer ring is empty");
            } else {
                rings_.push_back(std::move(ring));
            }
        }
        if (rings_.size() > first) {
            part_sizes_.push_back(static_cast<std::uint32_t>(rings_.size() - first));
        }
    }

    Ring read_ring(const Header& header) {
        const std::size_t count = read_count(header, header.position_size(), "positions");
        Ring ring;
        ring.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t end = position_ + header.position_size();
            const double x = read_ordinate(header);
            ring.push_back({x, read_ordinate(header)});
            position_ = end;
        }
        return ring;
    }

    /// Precondition: the file has room for it.
    double read_ordinate(const Header& header) {
        const std::size_t start = position_;
        const auto value = std::bit_cast<double>(number<std::uint64_t>(header.little_endian));
        if (!std::isfinite(value)) {
            fail(start, "not a finite number");
        }
        return value;
    }

    /// Points and lines; the position of an empty point is not a number.
    void skip_geometry(const Header& header) {
        if (header.type == point) {
            require(header.position_size(), "a position");
            position_ += header.position_size();
        } else if (header.type == line_string) {
            position_ +=
                read_count(header, header.position_size(), "positions") * header.position_size();
        } else {
            const std::uint32_t part = header.type == multi_point ? point : line_string;
            const std::size_t count = read_count(header, 5, "geometries");
            for (std::size_t i = 0; i < count; ++i) {
                const Header member = read_header();
                if (member.type != part) {
                    fail(member.start + 1, std::string("a ") + type_names[header.type] +
                                               " holds a " + type_names[member.type]);
                }
                skip_geometry(member);
            }
        }
    }

    std::string_view bytes_;
    const std::string& file_;
    SkippedParts& skipped_;
    std::size_t position_ = 0;
    std::vector<Ring> rings_;
    std::vector<std::uint32_t> part_sizes_;
};

/// The value of a hexadecimal digit; -1 for any other character.
int digit_value(char c) {
    if (is_digit(c)) {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

bool is_hex_prefix(std::string_view text) {
    return text.starts_with("\\x") || text.starts_with("0x") || text.starts_with("0X");
}

std::vector<Ring> parse_wkb(const std::string& bytes, const std::string& file,
                            SkippedParts& skipped, std::vector<std::uint32_t>* part_sizes) {
    WkbParser parser(bytes, file, skipped);
    std::vector<Ring> rings = parser.parse();
    if (part_sizes != nullptr) {
        *part_sizes = parser.part_sizes();
    }
    return rings;
}

std::vector<Ring> parse_hex_wkb(const std::string& text, const std::string& file,
                                SkippedParts& skipped, std::vector<std::uint32_t>* part_sizes) {
    std::string bytes;
    bytes.reserve(text.size() / 2);
    int high = -1;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (is_space(text[i])) {
            continue;
        }
        if (high < 0 && is_hex_prefix(std::string_view(text).substr(i))) {
            ++i;
            continue;
        }
        const int value = digit_value(text[i]);
        if (value < 0) {
            throw InputError(text_position(file, text, i) +
                             ": expected a hexadecimal digit of WKB");
        }
        if (high < 0) {
            high = value;
        } else {
            bytes.push_back(static_cast<char>(high * 16 + value));
            high = -1;
        }
    }
    if (high >= 0) {
        throw InputError(text_position(file, text, text.size()) +
                         ": an odd number of hexadecimal digits");
    }
    return parse_wkb(bytes, file, skipped, part_sizes);
}

}  // namespace nearfield::tools
