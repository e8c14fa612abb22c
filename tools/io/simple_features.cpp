#include <tools/io/input_error.hpp>
#include <tools/io/simple_features.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace nearfield::tools {

void SkippedParts::add(std::string_view kind, std::size_t count) {
    const auto found = std::find_if(counts_.begin(), counts_.end(),
                                    [kind](const auto& known) { return known.first == kind; });
    if (found == counts_.end()) {
        counts_.emplace_back(kind, count);
    } else {
        found->second += count;
    }
}

std::string SkippedParts::text() const {
    std::string text;
    for (const auto& [kind, count] : counts_) {
        text += (text.empty() ? "" : ", ") + kind + " (" + std::to_string(count) + ")";
    }
    return text;
}

std::string SkippedParts::no_polygon_text() const {
    return "holds no polygon" + (empty() ? std::string() : ", only " + text());
}

namespace {

using nlohmann::json;

/// One ordinate. The place of a vertex is formatted only for an error, because outlines are long.
double ordinate(const JsonPlace& ring, std::size_t vertex, std::size_t axis) {
    const json& value = ring.value()[vertex][axis];
    if (value.is_number()) {
        return value.get<double>();
    }
    return ring.element(vertex).element(axis).number();
}

Ring parse_ring(const JsonPlace& place) {
    const json& positions = place.require_array().value();
    if (positions.empty()) {
        place.fail("an empty ring");
    }
    Ring ring;
    ring.reserve(positions.size());
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
        const json& position = positions[vertex];
        if (!position.is_array()) {
            place.element(vertex).require_array();
        }
        if (position.size() < 2) {
            place.element(vertex).fail("a position needs two numbers, not " +
                                       std::to_string(position.size()));
        }
        ring.push_back({ordinate(place, vertex, 0), ordinate(place, vertex, 1)});
    }
    return ring;
}

/// The geometries of a document, one after the other.
class GeojsonReader {
public:
    explicit GeojsonReader(SkippedParts& skipped) : skipped_(skipped) {}

    void read(const JsonPlace& root) {
        const std::string& type = root.member("type").string();
        if (type == "Feature") {
            read_feature(root);
        } else if (type == "FeatureCollection") {
            read_features(root.member("features"));
        } else {
            read_geometry(root, 0);
        }
    }

    /// The rings of all that was read. `file`: for the message if there are none.
    std::vector<Ring> take_rings(const std::string& file) {
        if (rings_.empty()) {
            throw InputError(file + ": " + skipped_.no_polygon_text());
        }
        return std::move(rings_);
    }

    /// The number of rings of each polygon.
    [[nodiscard]] const std::vector<std::uint32_t>& part_sizes() const { return part_sizes_; }

private:
    void read_geometry(const JsonPlace& geometry, int depth) {
        const JsonPlace type = geometry.member("type");
        const std::string& name = type.string();
        if (name == "Polygon") {
            read_polygon(geometry.member("coordinates"));
        } else if (name == "MultiPolygon") {
            const JsonPlace coordinates = geometry.member("coordinates");
            for (std::size_t index = 0, count = count_of(coordinates); index < count; ++index) {
                read_polygon(coordinates.element(index));
            }
        } else if (name == "GeometryCollection") {
            if (depth == deepest_collection) {
                type.fail("collections nested too deep");
            }
            const JsonPlace geometries = geometry.member("geometries");
            for (std::size_t index = 0, count = count_of(geometries); index < count; ++index) {
                read_geometry(geometries.element(index), depth + 1);
            }
        } else if (name == "Point" || name == "MultiPoint" || name == "LineString" ||
                   name == "MultiLineString") {
            skipped_.add(name);
        } else {
            type.fail("\"" + name + "\" is none of Polygon, MultiPolygon, GeometryCollection");
        }
    }

    void read_polygon(const JsonPlace& coordinates) {
        const std::size_t first = rings_.size();
        bool has_outer_ring = true;
        for (std::size_t index = 0, count = count_of(coordinates); index < count; ++index) {
            const JsonPlace ring = coordinates.element(index);
            const bool any = count_of(ring) > 0;
            if (any && !has_outer_ring) {
                ring.fail("an inner ring whose outer ring is empty");
            }
            if (any) {
                rings_.push_back(parse_ring(ring));
            }
            has_outer_ring = has_outer_ring && (any || index > 0);
        }
        if (rings_.size() > first) {
            part_sizes_.push_back(static_cast<std::uint32_t>(rings_.size() - first));
        }
    }

    /// The size of an array, which is counted where it is empty.
    std::size_t count_of(const JsonPlace& array) {
        const std::size_t count = array.require_array().value().size();
        if (count == 0) {
            skipped_.add(empty_part);
        }
        return count;
    }

    void read_feature(const JsonPlace& feature) {
        if (!feature.has("geometry") || feature.member("geometry").value().is_null()) {
            skipped_.add("feature without geometry");
        } else {
            read_geometry(feature.member("geometry"), 0);
        }
    }

    void read_features(const JsonPlace& features) {
        const std::size_t count = features.require_array().value().size();
        for (std::size_t index = 0; index < count; ++index) {
            const JsonPlace feature = features.element(index);
            const JsonPlace type = feature.member("type");
            if (type.string() != "Feature") {
                type.fail("\"" + type.string() + "\" is not Feature");
            }
            read_feature(feature);
        }
    }

    SkippedParts& skipped_;
    std::vector<Ring> rings_;
    std::vector<std::uint32_t> part_sizes_;
};

}  // namespace

void append_rings(const JsonPlace& coordinates, std::vector<Ring>& rings) {
    const std::size_t count = coordinates.require_array().value().size();
    if (count == 0) {
        coordinates.fail("a polygon without rings");
    }
    for (std::size_t ring = 0; ring < count; ++ring) {
        rings.push_back(parse_ring(coordinates.element(ring)));
    }
}

namespace {

/// Stands before each text of a sequence (RFC 8142), which may be longer than a line.
constexpr char record_separator = '\x1E';

/// What separates the JSON texts of a sequence: a record separator, if it begins with one, or line
/// breaks, if its first line is complete and not the last. Zero for a single text.
char separator_of(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) {
        return '\0';
    }
    if (text[first] == record_separator) {
        return record_separator;
    }
    const std::size_t end = text.find('\n', first);
    const bool has_lines =
        end != std::string::npos && text.find_first_not_of(" \t\r\n", end) != std::string::npos;
    return has_lines && json::accept(text.substr(first, end - first)) ? '\n' : '\0';
}

/// A text that begins on this line of the file.
json parse_part(const std::string& part, std::size_t line, const std::string& file) {
    try {
        return parse_json(part, file);
    } catch (const InputError&) {
        // Line breaks are nothing to JSON; with them, the message names the place in the file.
        return parse_json(std::string(line - 1, '\n') + part, file);
    }
}

std::size_t lines_in(const std::string& text, std::size_t end) {
    const auto begin = text.begin();
    return static_cast<std::size_t>(
        std::count(begin, begin + static_cast<std::ptrdiff_t>(end), '\n'));
}

void read_sequence(const std::string& text, char separator, const std::string& file,
                   GeojsonReader& reader) {
    std::istringstream stream(text);
    std::size_t line = 1;
    for (std::string part; std::getline(stream, part, separator);) {
        const std::size_t first = part.find_first_not_of(" \t\r\n");
        if (first != std::string::npos) {
            const json document = parse_part(part, line, file);
            const std::size_t its_line = line + lines_in(part, first);
            reader.read(JsonPlace(document, file + ":" + std::to_string(its_line)));
        }
        line += lines_in(part, part.size()) + (separator == '\n' ? 1 : 0);
    }
}

}  // namespace

std::vector<Ring> parse_geojson(const std::string& text, const std::string& file,
                                SkippedParts& skipped, std::vector<std::uint32_t>* part_sizes) {
    GeojsonReader reader(skipped);
    if (const char separator = separator_of(text); separator != '\0') {
        read_sequence(text, separator, file, reader);
    } else {
        const json document = parse_json(text, file);
        reader.read(JsonPlace(document, file));
    }
    std::vector<Ring> rings = reader.take_rings(file);
    if (part_sizes != nullptr) {
        *part_sizes = reader.part_sizes();
    }
    return rings;
}

std::vector<Ring> parse_geojson(const std::string& text, const std::string& file) {
    SkippedParts skipped;
    return parse_geojson(text, file, skipped);
}

namespace {

enum class Kind { polygon, multi_polygon, collection, point_or_line };

struct NamedKind {
    std::string_view name;
    Kind kind;
};

/// None is the beginning of another: a dimension may be glued to a name.
constexpr std::array<NamedKind, 8> named_kinds{{
    {"POLYGON", Kind::polygon},
    {"MULTIPOLYGON", Kind::multi_polygon},
    {"GEOMETRYCOLLECTION", Kind::collection},
    {"POINT", Kind::point_or_line},
    {"MULTIPOINT", Kind::point_or_line},
    {"LINESTRING", Kind::point_or_line},
    {"LINEARRING", Kind::point_or_line},
    {"MULTILINESTRING", Kind::point_or_line},
}};

class WktParser {
public:
    WktParser(std::string_view text, const std::string& file, SkippedParts& skipped)
        : text_(text), file_(file), skipped_(skipped) {}

    /// One geometry, or several, one after the other.
    std::vector<Ring> parse() {
        std::size_t start = text_.size();
        do {
            skip_reference_system();
            start = std::min(start, (skip_space(), position_));
            parse_geometry(0);
            accept(';');
            skip_space();
        } while (position_ < text_.size() && is_letter(text_[position_]));
        if (position_ < text_.size()) {
            fail(position_, "text after the end of the geometry");
        }
        if (rings_.empty()) {
            fail(start, skipped_.no_polygon_text());
        }
        return std::move(rings_);
    }

    /// The number of rings of each polygon.
    [[nodiscard]] const std::vector<std::uint32_t>& part_sizes() const { return part_sizes_; }

private:
    /// How many numbers a position has.
    struct Ordinates {
        std::size_t fewest = 2;
        std::size_t most = 4;
    };

    [[noreturn]] void fail(std::size_t position, const std::string& reason) const {
        throw InputError(text_position(file_, text_, position) + ": " + reason);
    }

    void skip_space() {
        while (position_ < text_.size() && is_space(text_[position_])) {
            ++position_;
        }
    }

    std::string word() {
        skip_space();
        std::string letters;
        while (position_ < text_.size() && is_letter(text_[position_])) {
            letters += to_upper(text_[position_++]);
        }
        return letters;
    }

    void skip_reference_system() {
        const std::size_t start = position_;
        if (word() != "SRID") {
            position_ = start;
            return;
        }
        const std::size_t end = text_.find(';', position_);
        if (end == std::string_view::npos || position_ >= text_.size() || text_[position_] != '=') {
            fail(start, "expected SRID=...; before the geometry");
        }
        position_ = end + 1;
    }

    void parse_geometry(int depth) {
        const std::size_t start = (skip_space(), position_);
        const std::string type = word();
        const auto found =
            std::find_if(named_kinds.begin(), named_kinds.end(),
                         [&](const NamedKind& named) { return type.starts_with(named.name); });
        if (found == named_kinds.end()) {
            fail(start, type.empty() ? "expected POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION"
                                     : "\"" + type +
                                           "\" is none of POLYGON, MULTIPOLYGON, "
                                           "GEOMETRYCOLLECTION");
        }
        const Ordinates around = ordinates_;
        read_dimension(type.substr(found->name.size()));
        switch (found->kind) {
            case Kind::polygon:
                parse_polygon();
                break;
            case Kind::multi_polygon:
                parse_part([this] { parse_polygon(); });
                break;
            case Kind::collection:
                if (depth == deepest_collection) {
                    fail(start, "collections nested too deep");
                }
                parse_part([this, depth] { parse_geometry(depth + 1); });
                break;
            case Kind::point_or_line:
                skipped_.add(found->name);
                skip_positions();
                break;
        }
        ordinates_ = around;
    }

    /// Takes Z, M or ZM, glued to the type or a word of its own, and fixes the number of ordinates.
    void read_dimension(std::string tag) {
        const std::size_t start = (skip_space(), position_);
        if (tag.empty()) {
            tag = word();
        }
        if (tag == "EMPTY") {
            position_ = start;
        } else if (tag == "Z" || tag == "M") {
            ordinates_ = {3, 3};
        } else if (tag == "ZM") {
            ordinates_ = {4, 4};
        } else if (!tag.empty()) {
            fail(start, "\"" + tag + "\" is none of Z, M, ZM");
        }
    }

    /// "( item, item, ... )"; false where EMPTY stands in its place.
    template <class Item>
    bool parse_list(Item item) {
        const std::size_t start = (skip_space(), position_);
        if (word() == "EMPTY") {
            return false;
        }
        position_ = start;
        expect('(');
        item();
        while (accept(',')) {
            item();
        }
        expect(')');
        return true;
    }

    /// A list that is counted where it is EMPTY.
    template <class Item>
    bool parse_part(Item item) {
        const bool any = parse_list(item);
        if (!any) {
            skipped_.add(empty_part);
        }
        return any;
    }

    void parse_polygon() {
        const std::size_t first = rings_.size();
        bool is_first = true;
        bool has_outer_ring = true;
        parse_part([&] {
            const std::size_t start = (skip_space(), position_);
            Ring ring;
            const bool any = parse_part([&] { ring.push_back(parse_position()); });
            if (any && !has_outer_ring) {
                fail(start, "an inner ring whose outer ring is EMPTY");
            }
            if (any) {
                rings_.push_back(std::move(ring));
            }
            has_outer_ring = has_outer_ring && (any || !is_first);
            is_first = false;
        });
        if (rings_.size() > first) {
            part_sizes_.push_back(static_cast<std::uint32_t>(rings_.size() - first));
        }
    }

    /// The positions of points and lines: one, a list, or a list of lists.
    void skip_positions() {
        parse_list([this] {
            const std::size_t start = (skip_space(), position_);
            const bool is_list = accept('(') || word() == "EMPTY";
            position_ = start;
            if (is_list) {
                parse_list([this] { static_cast<void>(parse_position()); });
            } else {
                static_cast<void>(parse_position());
            }
        });
    }

    Vector2 parse_position() {
        const std::size_t start = (skip_space(), position_);
        double ordinates[4] = {};
        std::size_t count = 0;
        do {
            if (count == ordinates_.most) {
                fail(position_,
                     "a position has at most " + std::to_string(ordinates_.most) + " numbers here");
            }
            ordinates[count] = parse_number(count < 2);
            ++count;
            skip_space();
        } while (position_ < text_.size() && text_[position_] != ',' && text_[position_] != ')');
        if (count < ordinates_.fewest) {
            fail(start, "a position needs " + std::to_string(ordinates_.fewest) +
                            " numbers here, not " + std::to_string(count));
        }
        return {ordinates[0], ordinates[1]};
    }

    /// `is_used`: the number matters, so that it has to be one.
    double parse_number(bool is_used) {
        skip_space();
        const std::size_t start = position_;
        std::size_t first = start;
        if (first + 1 < text_.size() && text_[first] == '+' && text_[first + 1] != '-') {
            ++first;  // allowed by the format, not by from_chars
        }
        double number = 0.0;
        const char* const end = text_.data() + text_.size();
        const auto [rest, error] = std::from_chars(text_.data() + first, end, number);
        if (error == std::errc::result_out_of_range) {
            fail(start, "a number too large or too small for double precision");
        }
        if (error != std::errc{}) {
            fail(start, start < text_.size() ? "expected a number" : "the text ends too early");
        }
        if (is_used && !std::isfinite(number)) {
            fail(start, "not a finite number");
        }
        position_ = static_cast<std::size_t>(rest - text_.data());
        if (position_ < text_.size() && !is_space(text_[position_]) && text_[position_] != ',' &&
            text_[position_] != ')') {
            fail(start, "expected a number");
        }
        return number;
    }

    bool accept(char expected) {
        skip_space();
        if (position_ < text_.size() && text_[position_] == expected) {
            ++position_;
            return true;
        }
        return false;
    }

    void expect(char expected) {
        if (accept(expected)) {
            return;
        }
        if (position_ >= text_.size()) {
            fail(position_, std::string("the text ends where '") + expected + "' is expected");
        }
        fail(position_, std::string("expected '") + expected + "'");
    }

    std::string_view text_;
    const std::string& file_;
    SkippedParts& skipped_;
    std::size_t position_ = 0;
    Ordinates ordinates_;
    std::vector<Ring> rings_;
    std::vector<std::uint32_t> part_sizes_;
};

}  // namespace

std::vector<Ring> parse_wkt(const std::string& text, const std::string& file, SkippedParts& skipped,
                            std::vector<std::uint32_t>* part_sizes) {
    WktParser parser(text, file, skipped);
    std::vector<Ring> rings = parser.parse();
    if (part_sizes != nullptr) {
        *part_sizes = parser.part_sizes();
    }
    return rings;
}

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
