#include <tools/io/characters.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/svg_text.hpp>
#include <tools/io/text_file.hpp>

#include <charconv>
#include <cmath>
#include <system_error>

namespace nearfield::tools {
void SvgText::fail(std::size_t position, const std::string& reason) const {
    throw InputError(text_position(*file_, document_, offset_ + position) + ": " + reason);
}

void SvgText::skip_space() {
    while (is_space(peek())) {
        advance();
    }
}

void SvgText::skip_separator() {
    skip_space();
    if (peek() == ',') {
        advance();
        skip_space();
    }
}

bool SvgText::number_follows() const noexcept {
    return is_digit(peek()) || peek() == '.' || peek() == '-' || peek() == '+';
}

std::string SvgText::word() {
    std::string letters;
    while (is_letter(peek())) {
        letters += peek();
        advance();
    }
    return letters;
}

void SvgText::expect(char expected) {
    skip_space();
    if (peek() != expected) {
        fail(std::string("expected '") + expected + "'" +
             (position_ < value_.size() ? "" : " before the end"));
    }
    advance();
}

double SvgText::number() {
    std::size_t first = position_;
    if (peek() == '+') {
        ++first;  // allowed by SVG, not by from_chars
    }
    // The forms that from_chars accepts beyond the grammar (inf, nan, a sign after the plus) begin
    // differently.
    const std::size_t digits = peek() == '-' ? first + 1 : first;
    const std::size_t fraction =
        digits < value_.size() && value_[digits] == '.' ? digits + 1 : digits;
    if (fraction >= value_.size() || !is_digit(value_[fraction])) {
        fail(position_ < value_.size() ? "expected a number"
                                       : "the value ends where a number is expected");
    }
    double number = 0.0;
    const auto [rest, error] =
        std::from_chars(value_.data() + first, value_.data() + value_.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) {
        fail("a number too large or too small for double precision");
    }
    position_ = static_cast<std::size_t>(rest - value_.data());
    return number;
}

bool SvgText::flag() {
    const char c = peek();
    if (c != '0' && c != '1') {
        fail("expected a flag, 0 or 1");
    }
    advance();
    return c == '1';
}

}  // namespace nearfield::tools
