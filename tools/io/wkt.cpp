#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>
#include <tools/io/wkt.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <system_error>
#include <utility>

namespace nearfield::tools {
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

}  // namespace nearfield::tools
