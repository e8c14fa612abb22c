#include <tools/io/characters.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/wkt.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <system_error>

namespace nearfield::tools {
namespace {

char to_upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

class WktParser {
public:
    WktParser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    std::vector<Ring> parse() {
        skip_reference_system();
        const std::size_t start = (skip_space(), position_);
        std::string type = word();
        read_dimension(type);
        if (type == "POLYGON") {
            parse_polygon();
        } else if (type == "MULTIPOLYGON") {
            parse_list([this] { parse_polygon(); });
        } else {
            fail(start, type.empty() ? "expected POLYGON or MULTIPOLYGON"
                                     : "\"" + type + "\" is neither POLYGON nor MULTIPOLYGON");
        }
        skip_space();
        if (position_ < text_.size()) {
            fail(position_, "text after the end of the geometry");
        }
        return std::move(rings_);
    }

private:
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

    /// Reads Z, M or ZM, attached to the type or as a separate word, and sets the number of
    /// ordinates.
    void read_dimension(std::string& type) {
        std::string tag;
        for (const std::string_view name : {"MULTIPOLYGON", "POLYGON"}) {
            if (type.starts_with(name) && type.size() > name.size()) {
                tag = type.substr(name.size());
                type.resize(name.size());
            }
        }
        const std::size_t start = (skip_space(), position_);
        if (tag.empty()) {
            tag = word();
        }
        if (tag == "EMPTY") {
            fail(start, "an empty geometry");
        }
        if (tag == "Z" || tag == "M") {
            fewest_ordinates_ = max_ordinates_ = 3;
        } else if (tag == "ZM") {
            fewest_ordinates_ = max_ordinates_ = 4;
        } else if (!tag.empty()) {
            fail(start, "\"" + tag + "\" is none of Z, M, ZM");
        }
    }

    /// Parses "( item, item, ... )"; EMPTY is an error.
    template <class Item>
    void parse_list(Item item) {
        const std::size_t start = (skip_space(), position_);
        if (word() == "EMPTY") {
            fail(start, "an empty geometry");
        }
        position_ = start;
        expect('(');
        item();
        while (accept(',')) {
            item();
        }
        expect(')');
    }

    void parse_polygon() {
        parse_list([this] {
            rings_.emplace_back();
            parse_list([this] { parse_position(); });
        });
    }

    void parse_position() {
        const std::size_t start = (skip_space(), position_);
        double ordinates[4] = {};
        std::size_t count = 0;
        do {
            if (count == max_ordinates_) {
                fail(position_,
                     "a position has at most " + std::to_string(max_ordinates_) + " numbers here");
            }
            ordinates[count++] = parse_number();
            skip_space();
        } while (position_ < text_.size() && text_[position_] != ',' && text_[position_] != ')');
        if (count < fewest_ordinates_) {
            fail(start, "a position needs " + std::to_string(fewest_ordinates_) +
                            " numbers here, not " + std::to_string(count));
        }
        rings_.back().push_back({ordinates[0], ordinates[1]});
    }

    double parse_number() {
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
        if (!std::isfinite(number)) {
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
    std::size_t position_ = 0;
    std::size_t fewest_ordinates_ = 2;
    std::size_t max_ordinates_ = 4;
    std::vector<Ring> rings_;
};

}  // namespace

std::vector<Ring> parse_wkt(const std::string& text, const std::string& file) {
    return WktParser(text, file).parse();
}

}  // namespace nearfield::tools
